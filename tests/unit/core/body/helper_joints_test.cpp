#include "core/body/helper_joints.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/trig.h"
#include "core/body/ik.h"
#include "core/body/pose.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = 0.0174532925f;

std::vector<Affine> posed(const BapFrame& f) {
  const Skeleton s = upright_skeleton();
  std::vector<Affine> pose(kSkinJointCount);
  EXPECT_TRUE((PoseJob{.skeleton = &s, .baps = &f, .out = pose}).run().ok());
  EXPECT_TRUE(pose_helpers(s, pose).ok());
  return pose;
}

BapFrame turned(HanimJoint joint, Axis axis, float degrees) {
  BapFrame f;
  set_turn(f, joint, axis, degrees * kDegree);
  return f;
}

// How far a joint has turned a direction, degrees.
float angle(const Affine& m, Vec3 v) {
  const Vec3 w = m.direction(v);
  return atan2_of(glm::length(glm::cross(v, w)), glm::dot(v, w)) / kDegree;
}

TEST(HelperJoints, RestWithTheRest) {
  const auto pose = posed({});
  for (const Affine& m : pose)
    EXPECT_LT(glm::length(m.point({0.3f, 1.0f, 0.1f}) - Vec3(0.3f, 1.0f, 0.1f)), 1e-5f);
}

TEST(HelperJoints, ATwistWindsUpAlongTheForearm) {
  for (const HanimJoint joint : {HanimJoint::l_elbow, HanimJoint::l_wrist})
    for (const float degrees : {-100.0f, 60.0f}) {
      const auto pose = posed(turned(joint, Axis::y, degrees));
      const Vec3 out{1, 0, 0};
      EXPECT_LT(angle(pose[index_of(HelperJoint::l_forearm_near)], out), 3.0f);
      EXPECT_NEAR(angle(pose[index_of(HelperJoint::l_forearm_mid)], out), std::abs(degrees) / 2, 4);
      EXPECT_NEAR(angle(pose[index_of(HelperJoint::l_forearm_far)], out), std::abs(degrees), 5);
      EXPECT_LT(angle(pose[index_of(HelperJoint::r_forearm_far)], out), 0.1f);
    }
}

TEST(HelperJoints, ElbowsAndKneesBendInTwoHalves) {
  const auto arm = posed(turned(HanimJoint::r_elbow, Axis::x, -110.0f));
  EXPECT_NEAR(angle(arm[index_of(HelperJoint::r_elbow_half)], {0, -1, 0}), 55.0f, 0.1f);
  const auto leg = posed(turned(HanimJoint::l_knee, Axis::x, 120.0f));
  EXPECT_NEAR(angle(leg[index_of(HelperJoint::l_knee_half)], {0, -1, 0}), 60.0f, 0.1f);
}

TEST(HelperJoints, BonesKeepTheirEndsWhateverTheTwist) {
  const Skeleton s = upright_skeleton();
  BapFrame f = turned(HanimJoint::l_shoulder, Axis::y, 75.0f);
  set_turn(f, HanimJoint::l_shoulder, Axis::x, -0.8f);
  set_turn(f, HanimJoint::l_elbow, Axis::x, -1.0f);
  set_turn(f, HanimJoint::l_elbow, Axis::y, 1.2f);
  const auto pose = posed(f);
  const auto apart = [&](HelperJoint h, HanimJoint j, HanimJoint at) {
    return glm::distance(pose[index_of(h)].point(s.center(at)),
                         pose[index_of(j)].point(s.center(at)));
  };
  EXPECT_LT(apart(HelperJoint::l_upper_arm, HanimJoint::l_shoulder, HanimJoint::l_elbow), 1e-5f);
  EXPECT_LT(apart(HelperJoint::l_forearm_mid, HanimJoint::l_elbow, HanimJoint::l_wrist), 1e-5f);
  EXPECT_LT(apart(HelperJoint::l_forearm_near, HanimJoint::l_elbow, HanimJoint::l_elbow), 1e-5f);
}

TEST(HelperJoints, RefuseAnotherLength) {
  std::vector<Affine> few(kHanimJointCount);
  EXPECT_EQ(pose_helpers(upright_skeleton(), few).code, Code::invalid_argument);
}

}  // namespace
}  // namespace caryatid::body
