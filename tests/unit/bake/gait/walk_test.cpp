#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "assets/bake/gait/measure.h"
#include "core/base/crc.h"
#include "core/body/walker.h"

namespace caryatid::bake {
namespace {

using body::BapFrame;
using body::GaitMood;
using body::Skeleton;
using body::Walker;

constexpr float kFps = 30.0f;

Skeleton tall_or_small(float scale) {
  Skeleton s = body::upright_skeleton();
  for (Vec3& c : s.center_m) c *= scale;
  body::derive_soles(s);
  return s;
}

std::vector<BapFrame> record(Walker& walker, int count) {
  std::vector<BapFrame> frames(static_cast<std::size_t>(count));
  BapFrame frame;
  for (BapFrame& f : frames) {
    walker.step(1.0f / kFps, frame);
    f = frame;
  }
  return frames;
}

std::vector<BapFrame> steady(const Skeleton& s, const body::GaitStyle& style, int count) {
  Walker walker(&s);
  walker.set_style(style);
  walker.walk_to({0, 1000});
  record(walker, 180);
  return record(walker, count);
}

// Every mood on three sizes of body.
class EveryWalk : public testing::TestWithParam<std::tuple<int, float>> {
 protected:
  Skeleton skeleton = tall_or_small(std::get<1>(GetParam()));
  const body::GaitStyle& style = body::gait_style(GaitMood(std::get<0>(GetParam())));
  WalkMeasures measures =
      measure_walk(skeleton, steady(skeleton, style, 300), kFps, outline_points(skeleton));
};
INSTANTIATE_TEST_SUITE_P(Moods, EveryWalk,
                         testing::Combine(testing::Range(0, body::kGaitMoodCount),
                                          testing::Values(0.9f, 1.0f, 1.1f)));

TEST_P(EveryWalk, StandingFeetDoNotSlide) { EXPECT_LE(measures.slide_m, 0.001f); }
TEST_P(EveryWalk, SolesStayAboveTheFloor) { EXPECT_LE(measures.below_floor_m, 0.001f); }
TEST_P(EveryWalk, ToesClearTheFloorInMidSwing) { EXPECT_GE(measures.clearance_m, 0.005f); }
TEST_P(EveryWalk, PelvisRisesOnceAStep) {
  EXPECT_GE(measures.pelvis_travel_m, 0.005f);
  EXPECT_LE(measures.pelvis_travel_m, 0.07f);
  EXPECT_EQ(measures.fewest_maxima, 1);
  EXPECT_EQ(measures.most_maxima, 1);
}

TEST(Walk, LongerLegsTakeLongerSlowerSteps) {
  const auto walk = [](float scale) {
    const Skeleton s = tall_or_small(scale);
    return measure_walk(s, steady(s, body::gait_style(GaitMood::normal), 300), kFps,
                        outline_points(s));
  };
  const WalkMeasures small = walk(0.85f), tall = walk(1.15f);
  EXPECT_NEAR(tall.step_m / small.step_m, 1.15f / 0.85f, 0.08f);
  EXPECT_NEAR(tall.speed_mps / small.speed_mps, std::sqrt(1.15f / 0.85f), 0.08f);
}

TEST(Walk, ArrivesWhereItWasSentAndFacesTheVisitor) {
  const Skeleton s = body::upright_skeleton();
  for (const Vec2 place : {Vec2{2.0f, 1.0f}, Vec2{-3.0f, 0.2f}, Vec2{0.4f, -1.5f}, Vec2{0, 0.3f}}) {
    Walker walker(&s);
    walker.walk_to(place, 0.25f);
    std::vector<BapFrame> frames;
    for (int i = 0; i < 900 && !walker.arrived(); ++i) {
      const auto one = record(walker, 1);
      frames.push_back(one[0]);
    }
    EXPECT_TRUE(walker.arrived());
    EXPECT_LT(glm::length(walker.place() - place), 0.12f) << place.x << "," << place.y;
    EXPECT_NEAR(std::remainder(walker.heading_rad() - 0.25f, 6.2831853f), 0.0f, 0.06f);
    const WalkMeasures m = measure_walk(s, frames, kFps, outline_points(s));
    EXPECT_LE(m.slide_m, 0.001f) << place.x << "," << place.y;
    EXPECT_LE(m.below_floor_m, 0.001f);
  }
}

TEST(Walk, NothingJumpsBetweenFrames) {
  const Skeleton s = body::upright_skeleton();
  Walker walker(&s);
  walker.walk_to({2.5f, 0.5f}, 0.0f);
  BapFrame before;
  walker.step(1.0f / 60.0f, before);
  BapFrame now = before;
  for (int i = 0; i < 900; ++i) {
    if (i == 100) walker.set_style(body::gait_style(GaitMood::sad));
    if (i == 400) walker.walk_to({-1.0f, 0.0f}, 0.5f);
    walker.step(1.0f / 60.0f, now);
    for (int bap = 1; bap <= 180; ++bap)  // 0.35 rad a frame is 20 rad/s.
      EXPECT_LT(std::abs(now.get(bap) - before.get(bap)), 35000.0f) << i << " bap " << bap;
    for (int bap = 181; bap <= 183; ++bap)
      EXPECT_LT(std::abs(now.get(bap) - before.get(bap)), 60.0f) << i << " bap " << bap;
    before = now;
  }
}

TEST(Walk, StandingShiftsItsWeightButNotItsFeet) {
  const Skeleton s = body::upright_skeleton();
  Walker walker(&s);
  const auto frames = record(walker, 900);
  const WalkMeasures m = measure_walk(s, frames, kFps, outline_points(s));
  EXPECT_LE(m.slide_m, 0.0002f);
  float least = 1e9f, most = -1e9f;
  for (const BapFrame& f : frames) {
    least = std::min(least, f.get(182));
    most = std::max(most, f.get(182));
  }
  EXPECT_GT(most - least, 20.0f);
}

TEST(Walk, SameSeedSameStepsSameBits) {
  const Skeleton s = body::upright_skeleton();
  Walker a(&s), b(&s);
  a.walk_to({1, 2}, 0.3f);
  b.walk_to({1, 2}, 0.3f);
  const auto fa = record(a, 200), fb = record(b, 200);
  for (std::size_t i = 0; i < fa.size(); ++i) EXPECT_EQ(fa[i].value, fb[i].value);
}

TEST(Walk, RunningHasAFlightPhaseAndFirmFeet) {
  const Skeleton s = body::upright_skeleton();
  Walker walker(&s);
  walker.set_style(body::running_style());
  walker.walk_to({0, 1000});
  record(walker, 180);
  std::vector<BapFrame> frames;
  int flying = 0;
  for (int i = 0; i < 200; ++i) {
    frames.push_back(record(walker, 1)[0]);
    if (!walker.foot_planted(true) && !walker.foot_planted(false)) ++flying;
  }
  const WalkMeasures m = measure_walk(s, frames, kFps, outline_points(s));
  EXPECT_GT(flying, 30);
  EXPECT_LE(m.slide_m, 0.001f);
  EXPECT_LE(m.below_floor_m, 0.001f);
  EXPECT_GT(m.speed_mps, 2.0f);
  EXPECT_EQ(m.most_maxima, 1);
}

TEST(Walk, MoodsBlendOverThePlane) {
  for (int m = 0; m < body::kGaitMoodCount; ++m) {
    const Vec2 at = body::gait_mood_place(GaitMood(m));
    const body::GaitStyle there = body::gait_style_at(at.x, at.y);
    EXPECT_EQ(there.cycle_s, body::gait_style(GaitMood(m)).cycle_s);
  }
  EXPECT_GT(body::gait_style_at(-0.8f, -0.5f).cycle_s, body::gait_style_at(0.8f, 0.5f).cycle_s);
}

TEST(Walk, AnyPointOfThePlaneWalksOnFirmFeet) {
  const Skeleton s = body::upright_skeleton();
  for (float activation = -1.0f; activation <= 1.0f; activation += 0.5f)
    for (float evaluation = -1.0f; evaluation <= 1.0f; evaluation += 0.5f) {
      const auto frames = steady(s, body::gait_style_at(activation, evaluation), 120);
      const WalkMeasures m = measure_walk(s, frames, kFps, outline_points(s));
      EXPECT_LE(m.slide_m, 0.001f) << activation << "," << evaluation;
      EXPECT_LE(m.below_floor_m, 0.001f);
      EXPECT_GE(m.clearance_m, 0.005f);
    }
}

}  // namespace
}  // namespace caryatid::bake
