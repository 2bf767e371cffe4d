#include "core/body/joint_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/body/ik.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = 0.0174532925f;

TEST(JointLimits, LeaveWhatIsWellInsideAlone) {
  BapFrame f;
  set_turn(f, HanimJoint::l_hip, Axis::x, -60 * kDegree);
  set_turn(f, HanimJoint::r_knee, Axis::x, 60 * kDegree);
  set_turn(f, HanimJoint::l_elbow, Axis::x, -90 * kDegree);
  const BapFrame before = f;
  EXPECT_EQ(limit_joints(f).bitten, 0);
  EXPECT_EQ(f.value, before.value);
}

TEST(JointLimits, NeverLetAnAnglePassAndSayWhichWasWorst) {
  BapFrame f;
  set_turn(f, HanimJoint::l_knee, Axis::x, 200 * kDegree);
  set_turn(f, HanimJoint::r_elbow, Axis::x, 30 * kDegree);
  set_turn(f, HanimJoint::r_hip, Axis::z,
           60 * kDegree);  // Adduction of the right side: 31 at most.
  const LimitReport report = limit_joints(f);
  EXPECT_EQ(report.bitten, 3);
  EXPECT_EQ(report.worst_bap, 10);
  EXPECT_NEAR(report.worst_excess_rad, 87 * kDegree, 1e-4f);
  EXPECT_LE(get_turn(f, HanimJoint::l_knee, Axis::x), 113.01f * kDegree);
  EXPECT_LE(get_turn(f, HanimJoint::r_elbow, Axis::x), 0.0f);
  EXPECT_LE(get_turn(f, HanimJoint::r_hip, Axis::z), 31.01f * kDegree);
}

TEST(JointLimits, BiteSmoothlyAndInOrder) {
  float before = -1e9f;
  for (float deg = 0; deg < 250; deg += 0.25f) {
    BapFrame f;
    set_turn(f, HanimJoint::l_knee, Axis::x, deg * kDegree);
    limit_joints(f);
    const float now = get_turn(f, HanimJoint::l_knee, Axis::x);
    EXPECT_GE(now, before);
    if (deg > 0) {
      EXPECT_LE(now - before, 0.2501f * kDegree);
    }
    before = now;
  }
}

TEST(JointLimits, HoldForTheNeckAsAWhole) {
  BapFrame f;
  for (int j = 0; j < 8; ++j)
    set_turn(f, static_cast<HanimJoint>(index_of(HanimJoint::vc7) + static_cast<std::size_t>(j)),
             Axis::y, 30 * kDegree);
  EXPECT_EQ(limit_joints(f).bitten, 1);
  float sum = 0;
  for (int j = 0; j < 8; ++j)
    sum += get_turn(
        f, static_cast<HanimJoint>(index_of(HanimJoint::vc7) + static_cast<std::size_t>(j)),
        Axis::y);
  EXPECT_LE(sum, 79.01f * kDegree);
  EXPECT_GT(sum, 70 * kDegree);
}

TEST(JointLimits, ReadPlainAxesAsTheyAreMeant) {
  BapFrame f;
  f.set(10, 200 * kDegree * 1e5f);  // Left knee: bent where all axes are positive.
  EXPECT_EQ(limit_joints(f, BapConvention::plain_axes).bitten, 1);
  EXPECT_GT(f.get(10), 100 * kDegree * 1e5f);
  EXPECT_LE(f.get(10), 113.01f * kDegree * 1e5f);
  f.set(10, 60 * kDegree * 1e5f);
  EXPECT_EQ(limit_joints(f).bitten, 1);  // The same number bends it backwards here.
}

TEST(JointLimits, TameHostileValues) {
  for (const float v :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30f}) {
    BapFrame f;
    for (int bap = 1; bap <= kBapCount; ++bap) f.set(bap, v);
    limit_joints(f);
    EXPECT_LE(std::abs(get_turn(f, HanimJoint::l_knee, Axis::x)), 114 * kDegree);
  }
}

}  // namespace
}  // namespace caryatid::body
