#include "core/face/fat.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/base/trig.h"
#include "core/face/transforms.h"

namespace caryatid::face {
namespace {

constexpr pack::Channel kTwoPieces[] = {
    {3, 0, 0, 100, 0, 0}, {3, 0, 100, 300, 0, 0}, {3, 0, 0, -50, 0, 0}, {5, 3, 0, -80, 0, 100}};

std::array<float, 4> weights_at(float fap3, float fap5 = 0.0f) {
  FapFrame frame;
  frame.set(3, fap3);
  frame.set(5, fap5);
  std::array<float, 4> out{};
  EXPECT_TRUE(evaluate_channels(kTwoPieces, frame, out).ok());
  return out;
}

TEST(Channels, ZeroFrameMovesNothing) {
  EXPECT_EQ(weights_at(0), (std::array<float, 4>{0, 0, 0, 0}));
}

TEST(Channels, IntervalsFollowEachOther) {
  EXPECT_EQ(weights_at(50), (std::array<float, 4>{0.5f, 0, 0, 0}));
  EXPECT_EQ(weights_at(200), (std::array<float, 4>{1, 0.5f, 0, 0}));
  EXPECT_EQ(weights_at(1e9f), (std::array<float, 4>{1, 1, 0, 0}));
  EXPECT_EQ(weights_at(-25), (std::array<float, 4>{0, 0, 0.5f, 0}));
}

TEST(Channels, PartnerScalesACorrection) {
  EXPECT_EQ(weights_at(50, -40)[3], 0.25f);
  EXPECT_EQ(weights_at(0, -40)[3], 0.0f);
}

TEST(Channels, NanAndInfinityAreHarmless) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(weights_at(nan, nan), (std::array<float, 4>{0, 0, 0, 0}));
  EXPECT_EQ(weights_at(inf, -inf), (std::array<float, 4>{1, 1, 0, 1}));
}

TEST(Channels, ShortOutputIsRefused) {
  std::array<float, 3> out{};
  EXPECT_EQ(evaluate_channels(kTwoPieces, FapFrame{}, out).code, Code::out_of_capacity);
}

TEST(Channels, LimitsAreTheEndsOfTheTable) {
  const FapLimits limits = limits_of(kTwoPieces);
  EXPECT_EQ(limits.high[3], 300.0f);
  EXPECT_EQ(limits.low[3], -50.0f);
  EXPECT_EQ(limits.low[5], 0.0f) << "a correction is not a range";
}

TransformGeometry adult() {
  return {.eye_separation_m = 0.062f,
          .iris_diameter_m = 0.0115f,
          .mouth_nose_m = 0.02f,
          .mouth_width_m = 0.05f,
          .jaw_center_m = {0, 1.62f, 0.02f},
          .chin_m = {0, 1.53f, 0.11f}};
}

TEST(Transforms, ZeroFrameTurnsNothing) {
  const FaceTransforms t = evaluate_transforms(adult(), FapFrame{});
  for (const Quat& q : {t.head, t.left_eye, t.right_eye, t.jaw}) EXPECT_NEAR(q.w, 1.0f, 1e-6f);
  EXPECT_EQ(t.jaw_shift_m, Vec3(0));
}

TEST(Transforms, JawLowersTheChinByTheFapuAmount) {
  const TransformGeometry g = adult();
  FapFrame frame;
  frame.set(3, 900.0f);
  const Quat jaw = evaluate_transforms(g, frame).jaw;
  const Vec3 moved = g.jaw_center_m + jaw * (g.chin_m - g.jaw_center_m);
  EXPECT_NEAR(g.chin_m.y - moved.y, 900.0f * 0.02f / 1024.0f, 2e-6f);
  EXPECT_LT(moved.z, g.chin_m.z) << "the chin swings back as it drops";
}

TEST(Transforms, DirectionsOfTheStandard) {
  FapFrame frame;
  frame.set(23, 30000.0f);  // Yaw: left.
  frame.set(26, 30000.0f);  // Pitch: down.
  frame.set(50, 30000.0f);  // Roll: right.
  const FaceTransforms t = evaluate_transforms(adult(), frame);
  EXPECT_NEAR((t.left_eye * Vec3(0, 0, 1)).x, sin_of(0.3f), 1e-5f);
  EXPECT_NEAR((t.right_eye * Vec3(0, 0, 1)).y, -sin_of(0.3f), 1e-5f);
  EXPECT_NEAR((t.head * Vec3(0, 1, 0)).x, -sin_of(0.3f), 1e-5f);
}

}  // namespace
}  // namespace caryatid::face
