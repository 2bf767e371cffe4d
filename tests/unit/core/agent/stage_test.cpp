#include "core/agent/stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/crc.h"
#include "core/base/trig.h"
#include "core/body/bap_axes.h"
#include "core/body/ik.h"
#include "core/body/pose.h"

namespace caryatid::agent {
namespace {

constexpr float kFrame_s = 1.0f / 30.0f;
const Vec3 kCamera_m{0.0f, 1.5f, 4.5f};

struct Show {
  explicit Show(StageSetup setup = {}) : stage(&skeleton, setup) {}
  void frame(bool pressed = false, bool busy = false) {
    will.pressed = pressed;
    will.busy = busy || pressed;
    stage.step(kFrame_s, will, kCamera_m);
  }
  // Seconds until the phase comes, at most `limit_s`.
  float until(Stage::Phase phase, float limit_s, bool busy = false) {
    float t = 0.0f;
    for (; t < limit_s && stage.phase() != phase; t += kFrame_s) frame(false, busy);
    return t;
  }
  void run(float seconds, bool busy = false) {
    for (float t = 0.0f; t < seconds; t += kFrame_s) frame(false, busy);
  }
  float x() const { return stage.walker().place().x; }

  body::Skeleton skeleton = [] {
    body::Skeleton s = body::upright_skeleton();
    body::derive_soles(s);
    return s;
  }();
  Stage stage;
  Intentions will;
};

TEST(Follower, ComesToItsTargetSmoothlyAtAnyRate) {
  Follower fine, coarse;
  for (int i = 0; i < 100; ++i) fine.step(1.0f, 3.0f, 0.01f);
  for (int i = 0; i < 5; ++i) coarse.step(1.0f, 3.0f, 0.2f);
  EXPECT_NEAR(fine.value, coarse.value, 1e-4f);
  Follower slow;
  EXPECT_LT(slow.step(1.0f, 3.0f, 0.01f), 0.001f);  // No jerk at the start.
  for (int i = 0; i < 300; ++i) EXPECT_LE(slow.step(1.0f, 3.0f, 0.01f), 1.0f + 1e-6f);
}

TEST(Stage, WalksInTurnsAndTheCameraComes) {
  Show show;
  EXPECT_EQ(show.stage.phase(), Stage::Phase::entering);
  EXPECT_GT(show.x(), 1.6f);  // Out of the picture.
  EXPECT_FLOAT_EQ(show.stage.closeness(), 0.0f);
  EXPECT_LT(show.until(Stage::Phase::present, 10.0f), 6.0f);
  EXPECT_NEAR(show.x(), 0.0f, 0.12f);
  EXPECT_GT(cos_of(show.stage.walker().heading_rad()), 0.998f);
  show.run(2.0f);
  EXPECT_GT(show.stage.closeness(), 0.98f);
  EXPECT_FALSE(show.stage.phase() != Stage::Phase::present);
}

TEST(Stage, CameraMovesWithoutAJump) {
  Show show;
  float before = show.stage.closeness(), fastest = 0.0f;
  for (int i = 0; i < 300; ++i) {
    show.frame();
    fastest = std::max(fastest, std::abs(show.stage.closeness() - before));
    before = show.stage.closeness();
  }
  EXPECT_LT(fastest, 0.08f);  // Of the whole way, in a frame.
  EXPECT_GT(fastest, 0.01f);
}

TEST(Stage, PressEndsTheWalkSoon) {
  Show calm, called;
  calm.run(0.8f);
  called.run(0.8f);
  called.frame(true);
  const float undisturbed_s = calm.until(Stage::Phase::present, 10.0f);
  EXPECT_LT(called.until(Stage::Phase::present, 10.0f, true), undisturbed_s - 0.5f);
  EXPECT_GT(called.x(), 0.3f);
  EXPECT_LT(called.x(), 1.3f);  // Within the picture.
  EXPECT_GT(cos_of(called.stage.walker().heading_rad()), 0.998f);
}

TEST(Stage, MorePressesDoNotMakeHerWalkOn) {
  Show once, often;
  for (Show* show : {&once, &often}) {
    show->run(0.8f);
    show->frame(true);
  }
  for (int i = 0; i < 240; ++i) {
    once.frame(false, true);
    often.frame(i % 20 == 0, true);
  }
  EXPECT_FLOAT_EQ(once.x(), often.x());
  EXPECT_EQ(often.stage.phase(), Stage::Phase::present);
}

TEST(Stage, WalksOffWhenNobodyComesAndReturnsAtAPress) {
  Show show;
  show.until(Stage::Phase::present, 10.0f);
  show.run(StageSetup{}.sleep_s + 30.0f, true);
  EXPECT_EQ(show.stage.phase(), Stage::Phase::present);  // As long as somebody is there.
  show.run(StageSetup{}.sleep_s + 0.2f);
  EXPECT_EQ(show.stage.phase(), Stage::Phase::leaving);
  EXPECT_LT(show.until(Stage::Phase::away, 20.0f), 8.0f);
  EXPECT_LT(show.x(), -1.8f);  // To the other side.
  EXPECT_LT(show.stage.closeness(), 0.01f);
  show.frame(true);
  EXPECT_EQ(show.stage.phase(), Stage::Phase::entering);
  EXPECT_LT(show.until(Stage::Phase::present, 10.0f, true), 5.0f);
  EXPECT_LT(std::abs(show.x()), 1.3f);
}

TEST(Stage, ReturnsUnaskedAfterAWhile) {
  Show show;
  show.until(Stage::Phase::present, 10.0f);
  show.until(Stage::Phase::away, StageSetup{}.sleep_s + 20.0f);
  EXPECT_NEAR(show.until(Stage::Phase::entering, 100.0f), Stage::kAway_s, 0.2f);
}

TEST(Stage, PressWhileSheLeavesBringsHerBack) {
  Show show;
  show.until(Stage::Phase::present, 10.0f);
  show.until(Stage::Phase::leaving, StageSetup{}.sleep_s + 5.0f);
  show.run(2.5f);
  ASSERT_LT(show.x(), -0.1f);  // Under way.
  show.frame(true);
  EXPECT_LT(show.until(Stage::Phase::present, 10.0f, true), 5.0f);
  EXPECT_LT(std::abs(show.x()), 1.6f);
  EXPECT_GT(cos_of(show.stage.walker().heading_rad()), 0.998f);
}

TEST(Stage, StandsFromTheStartWhereSheDoesNotWalk) {
  Show show({.walks = false});
  EXPECT_EQ(show.stage.phase(), Stage::Phase::present);
  show.run(StageSetup{}.sleep_s + 20.0f);
  EXPECT_EQ(show.stage.phase(), Stage::Phase::present);
  EXPECT_LT(std::abs(show.x()), 0.08f);
  EXPECT_FALSE(show.stage.moving());
}

TEST(Stage, PortraitPicturesAreLeftAndEnteredToo) {
  Show show({.half_width_m = 0.43f});
  EXPECT_GE(show.x(), 1.2f);
  show.run(0.4f);
  show.frame(true);
  show.until(Stage::Phase::present, 10.0f, true);
  EXPECT_LT(std::abs(show.x()), 0.25f);
}

// The gaze of a posed head whose eyes turn by FAPs 23 and 25.
Vec3 gaze(const Show& show) {
  std::array<Affine, body::kHanimJointCount> pose;
  const body::PoseJob job{.skeleton = &show.skeleton, .baps = &show.stage.body(), .out = pose};
  EXPECT_TRUE(job.run().ok());
  const float yaw = show.stage.idle_face().get(23) * 1e-5f;
  const float down = show.stage.idle_face().get(25) * 1e-5f;
  const SinCos y = sin_cos(yaw), d = sin_cos(down);
  const Affine& skull = pose[body::index_of(body::HanimJoint::skullbase)];
  return skull.direction({y.sin * d.cos, -d.sin, y.cos * d.cos});
}

TEST(Stage, EyesHoldTheVisitorWhileTheBodyTurns) {
  Show show;
  int turning = 0;
  for (int i = 0; i < 240; ++i) {
    show.frame();
    const float heading = std::abs(show.stage.walker().heading_rad());
    if (show.stage.walker().vigour() > 0.0f || heading > 0.9f) continue;
    turning += heading > 0.2f ? 1 : 0;
    const Vec3 way = glm::normalize(kCamera_m - show.stage.eyes_m());
    EXPECT_GT(glm::dot(gaze(show), way), 0.99f) << i << " " << heading;
  }
  EXPECT_GT(turning, 3);
}

TEST(Stage, NeckStaysWithinItsLimit) {
  Show show;
  for (int i = 0; i < 300; ++i) {
    show.frame();
    float turn = 0.0f;
    for (std::size_t j = body::index_of(body::HanimJoint::vc7);
         j <= body::index_of(body::HanimJoint::skullbase); ++j)
      turn += body::get_turn(show.stage.body(), static_cast<body::HanimJoint>(j), body::Axis::y);
    EXPECT_LT(std::abs(turn), Stage::kNeckTurn_rad + 0.15f);
  }
}

TEST(Stage, ReplaysBitForBit) {
  std::uint64_t hashes[2];
  for (std::uint64_t& h : hashes) {
    Show show;
    h = kHashSeed;
    for (int i = 0; i < 200; ++i) {
      show.frame(i == 40);
      h = hash_of(std::span<const float>(show.stage.body().value), h);
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Stage, AStallOrAWrongClockDoesNotThrowHer) {
  Show show;
  show.run(1.0f);
  const float x = show.x();
  show.stage.step(-3.0f, show.will, kCamera_m);
  EXPECT_NEAR(show.x(), x, 1e-3f);
  show.stage.step(std::nanf(""), show.will, kCamera_m);
  EXPECT_NEAR(show.x(), x, 1e-3f);
  show.stage.step(100.0f, show.will, kCamera_m);
  EXPECT_NEAR(show.x(), x, 0.3f);
}

}  // namespace
}  // namespace caryatid::agent
