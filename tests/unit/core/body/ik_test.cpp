#include "core/body/ik.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/random.h"
#include "core/body/foot_roll.h"
#include "core/body/legs.h"
#include "core/body/pose.h"

namespace caryatid::body {
namespace {

// The end of a limb after its rotations, from the upper joint.
Vec3 end_of(const Skeleton& s, const Limb& l, const LimbPose& p) {
  return p.upper * (s.center(l.hinge) - s.center(l.upper) +
                    rotation_x(p.hinge_rad) * (s.center(l.end) - s.center(l.hinge)));
}

TEST(Ik, MeetsEveryTargetWithinReach) {
  Random random(3);
  for (const Skeleton& s : {upright_skeleton(), default_skeleton()})
    for (const Limb* l : {&leg(true), &leg(false), &arm(true), &arm(false)})
      for (int i = 0; i < 200; ++i) {
        const float all = upper_length(s, *l) + lower_length(s, *l);
        Vec3 to{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        to = to * (random.between(0.65f, 0.99f) * all / glm::length(to));
        const LimbPose p = solve_limb(s, *l, {.reach_m = to});
        EXPECT_LT(glm::length(end_of(s, *l, p) - to), 2e-4f);
        EXPECT_LT(p.missed_m, 2e-4f);
      }
}

TEST(Ik, PointsAtWhatIsTooFarAndSaysByHowMuch) {
  const Skeleton s = upright_skeleton();
  const LimbPose p = solve_limb(s, arm(true), {.reach_m = {0, 0, 2.0f}});
  EXPECT_NEAR(p.flexion_rad, 0.0f, 1e-3f);
  EXPECT_NEAR(p.missed_m, 2.0f - upper_length(s, arm(true)) - lower_length(s, arm(true)), 1e-3f);
  EXPECT_GT(end_of(s, arm(true), p).z, 0.5f);
}

TEST(Ik, KneesBendForwardAndElbowsBack) {
  const Skeleton s = upright_skeleton();
  const LimbPose l = solve_limb(s, leg(true), {.reach_m = {0, -0.7f, 0}});
  const Vec3 knee = l.upper * (s.center(HanimJoint::l_knee) - s.center(HanimJoint::l_hip));
  EXPECT_GT(knee.z, 0.1f);
  const LimbPose a = solve_limb(s, arm(true), {.reach_m = {0, -0.4f, 0}});
  const Vec3 elbow = a.upper * (s.center(HanimJoint::l_elbow) - s.center(HanimJoint::l_shoulder));
  EXPECT_LT(elbow.z, -0.1f);
}

TEST(Ik, HingesStopAtTheirLimits) {
  const Skeleton s = upright_skeleton();
  const LimbPose p = solve_limb(s, leg(false), {.reach_m = {0, -0.05f, 0}});
  EXPECT_FLOAT_EQ(p.flexion_rad, leg(false).hinge_max_rad);
  EXPECT_GT(p.missed_m, 0.1f);
}

TEST(Ik, EulerAnglesGiveTheRotationBack) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Mat3 r = rotation_x(random.between(-3, 3)) * rotation_z(random.between(-1.5f, 1.5f)) *
                   rotation_y(random.between(-3, 3));
    const EulerXzy e = euler_xzy(r);
    const Mat3 back = rotation_x(e.x) * rotation_z(e.z) * rotation_y(e.y);
    for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(back[c] - r[c]), 1e-5f);
  }
}

TEST(Legs, FeetStandWhereTheyAreWanted) {
  for (const Skeleton& s : {upright_skeleton(), default_skeleton()}) {
    LowerBody body{.hips_m = {1.0f, 0.86f, -2.0f},
                   .heading_rad = 0.7f,
                   .torsion_rad = 0.1f,
                   .roll_rad = -0.06f};
    const Mat3 h = rotation_y(0.7f);
    body.foot[0] = {body.hips_m + h * Vec3{0.1f, -0.76f, 0.2f}, 0.9f, 0.2f, 0.1f};
    body.foot[1] = {body.hips_m + h * Vec3{-0.05f, -0.75f, -0.2f}, 0.6f, -0.5f, 0.4f};
    BapFrame f;
    EXPECT_LT(pose_lower_body(s, body, f), 2e-4f);
    std::vector<Affine> pose(kHanimJointCount);
    ASSERT_TRUE((PoseJob{.skeleton = &s, .baps = &f, .out = pose}).run().ok());
    for (const bool left : {true, false}) {
      const FootTarget& t = body.foot[left ? 0 : 1];
      const HanimJoint ankle = left ? HanimJoint::l_ankle : HanimJoint::r_ankle;
      const HanimJoint hind = left ? HanimJoint::l_midtarsal : HanimJoint::r_midtarsal;
      const Mat3 foot = rotation_y(t.yaw_rad) * rotation_x(-t.pitch_rad);
      const Vec3 toe = s.center(ankle) + Vec3{0.02f, -0.05f, 0.12f};
      const Vec3 wanted = t.ankle_m + foot * (toe - s.center(ankle));
      EXPECT_LT(glm::length(pose[index_of(hind)].point(toe) - wanted), 4e-4f);
      EXPECT_LT(glm::length(joint_position(s, pose, left ? HanimJoint::l_hip : HanimJoint::r_hip) -
                            hip_position(s, body, left)),
                1e-5f);
    }
  }
}

TEST(FootRoll, NoPartOfARollingFootIsUnderTheFloor) {
  const FootShape shape = foot_shape(upright_skeleton(), true);
  for (float pitch = -1.3f; pitch < 0.6f; pitch += 0.01f) {
    const FootRoll roll = roll_foot(shape, pitch, 0.55f);
    EXPECT_NEAR(lowest_point(shape, roll.ankle, pitch, roll.toe_extension_rad), 0.0f, 3e-4f)
        << pitch;
  }
}

TEST(FootRoll, IsContinuous) {
  const FootShape shape = foot_shape(upright_skeleton(), true);
  Vec2 before = roll_foot(shape, -1.3f, 0.55f).ankle;
  for (float pitch = -1.299f; pitch < 0.6f; pitch += 0.001f) {
    const Vec2 now = roll_foot(shape, pitch, 0.55f).ankle;
    EXPECT_LT(glm::length(now - before), 3e-4f);
    before = now;
  }
}

}  // namespace
}  // namespace caryatid::body
