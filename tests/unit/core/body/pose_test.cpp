#include "core/body/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "core/base/trig.h"
#include "core/body/hanim.h"

namespace caryatid::body {
namespace {

struct Posed {
  std::vector<Affine> joint = std::vector<Affine>(kHanimJointCount);
  Vec3 at(const Skeleton& s, HanimJoint j) const { return joint_position(s, joint, j); }
};

Posed pose(const Skeleton& s, const BapFrame& f,
           BapConvention convention = BapConvention::signed_axes) {
  Posed p;
  EXPECT_TRUE(
      (PoseJob{.skeleton = &s, .baps = &f, .convention = convention, .out = p.joint}).run().ok());
  return p;
}

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Hanim, NamesAreFoundBack) {
  for (std::size_t j = 0; j < kHanimJointCount; ++j) {
    const char* name = hanim_info(static_cast<HanimJoint>(j)).name;
    const auto found = find_hanim_joint({name, std::strlen(name)});
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(index_of(found.value), j);
  }
  EXPECT_FALSE(find_hanim_joint(std::span<const char>("tail", 4)).ok());
}

TEST(Hanim, MirroredJointsAreMirrorImages) {
  for (std::size_t j = 0; j < kHanimJointCount; ++j) {
    const auto joint = static_cast<HanimJoint>(j);
    EXPECT_EQ(mirrored(mirrored(joint)), joint);
    const Vec3 a = hanim_info(joint).center_m;
    const Vec3 b = hanim_info(mirrored(joint)).center_m;
    if (mirrored(joint) != joint) expect_near(a, {-b.x, b.y, b.z});
  }
}

TEST(Pose, ZeroFrameIsTheRestPoseExactly) {
  const Skeleton s = default_skeleton();
  const Posed p = pose(s, BapFrame{});
  for (std::size_t j = 0; j < kHanimJointCount; ++j)
    EXPECT_EQ(p.at(s, static_cast<HanimJoint>(j)), s.center_m[j]);
}

TEST(Pose, EveryRotationalBapMovesWhatItsJointCarries) {
  const Skeleton s = default_skeleton();
  for (int bap = 1; bap <= 186; ++bap) {
    if (bap >= 181 && bap <= 183) continue;
    BapFrame f;
    f.set(bap, 50000.0f);
    const Posed p = pose(s, f);
    const BapAxis axis = bap_axis(bap);
    const std::size_t j = index_of(axis.joint);
    // The joint's frame turns by 0.5 rad about the axis, its centre stays.
    expect_near(p.at(s, axis.joint), s.center_m[j]);
    Vec3 e(0.0f);
    e[static_cast<int>(axis.axis)] = 1.0f;
    expect_near(p.joint[j].direction(e), e);
    Vec3 across(0.0f);
    across[(static_cast<int>(axis.axis) + 1) % 3] = 1.0f;
    EXPECT_NEAR(glm::dot(p.joint[j].direction(across), across), std::cos(0.5f), 1e-5f) << bap;
  }
}

TEST(Pose, SignsFollowTheNamedConvention) {
  const Skeleton s = upright_skeleton();
  BapFrame f;
  f.set(4, 50000.0f);
  EXPECT_GT(pose(s, f).at(s, HanimJoint::l_knee).z, 0.15f);
  EXPECT_LT(pose(s, f, BapConvention::plain_axes).at(s, HanimJoint::l_knee).z, -0.15f);
  BapFrame knee;
  knee.set(10, -50000.0f);
  EXPECT_LT(pose(s, knee).at(s, HanimJoint::l_ankle).z, -0.15f);  // The shank swings back.
}

TEST(Pose, AnglesOfAJointComposeInListingOrder) {
  const Skeleton s = upright_skeleton();
  BapFrame f;
  f.set(4, 60000.0f);   // flexion
  f.set(6, 30000.0f);   // abduction
  f.set(8, -20000.0f);  // twist
  const auto about = [](float angle, Vec3 axis) {
    const SinCos h = sin_cos(angle / 2);
    return Quat(h.cos, axis * h.sin);
  };
  const Quat listed = about(0.6f, {-1, 0, 0}) * about(0.3f, {0, 0, 1}) * about(-0.2f, {0, -1, 0});
  const Quat reversed = about(-0.2f, {0, -1, 0}) * about(0.3f, {0, 0, 1}) * about(0.6f, {-1, 0, 0});
  const Vec3 v{0.2f, -0.9f, 0.3f};
  const std::size_t hip = index_of(HanimJoint::l_hip);
  expect_near(pose(s, f).joint[hip].direction(v), listed * v);
  expect_near(pose(s, f, BapConvention::signed_axes_reversed).joint[hip].direction(v),
              reversed * v);
}

TEST(Pose, RootTranslatesInMillimetres) {
  const Skeleton s = default_skeleton();
  BapFrame f;
  f.set(181, -100.0f);
  f.set(182, 200.0f);
  f.set(183, 300.0f);
  const Vec3 moved = pose(s, f).at(s, HanimJoint::skullbase);
  expect_near(moved - s.center(HanimJoint::skullbase), {0.2f, -0.1f, 0.3f});
}

TEST(Pose, ExtraRotationTurnsInsideTheBap) {
  const Skeleton s = default_skeleton();
  std::vector<Quat> extra(kHanimJointCount, Quat(1, 0, 0, 0));
  const SinCos h = sin_cos(0.2f);
  extra[index_of(HanimJoint::l_eyeball_joint)] = Quat(h.cos, Vec3(0, h.sin, 0));
  std::vector<Affine> out(kHanimJointCount);
  const BapFrame f;
  ASSERT_TRUE((PoseJob{.skeleton = &s, .baps = &f, .extra = extra, .out = out}).run().ok());
  const Vec3 gaze = out[index_of(HanimJoint::l_eyeball_joint)].direction({0, 0, 1});
  EXPECT_NEAR(std::atan2(gaze.x, gaze.z), 0.4f, 1e-5f);
  expect_near(out[index_of(HanimJoint::skullbase)].direction({0, 0, 1}), {0, 0, 1});
}

TEST(Pose, HostileValuesStayFinite) {
  const Skeleton s = default_skeleton();
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::max(),
                       -1e30f,
                       1e-40f};
  for (const float v : bad) {
    BapFrame f;
    for (int bap = 1; bap <= kBapCountExtended; ++bap) f.set(bap, v);
    const Posed p = pose(s, f);
    for (const Affine& a : p.joint)
      for (const Vec4& row : a.row)
        for (int c = 0; c < 4; ++c) EXPECT_LT(std::abs(row[c]), 1e5f);
  }
}

TEST(Pose, BonesKeepTheirLengthAtAnyAngles) {
  const Skeleton s = default_skeleton();
  BapFrame f;
  for (int bap = 1; bap <= 180; ++bap)
    f.set(bap, static_cast<float>((bap * 7919) % 200000 - 100000));
  const Posed p = pose(s, f);
  for (std::size_t j = 1; j < kHanimJointCount; ++j) {
    const auto joint = static_cast<HanimJoint>(j);
    const float rest = glm::length(s.center(joint) - s.center(hanim_parent(joint)));
    EXPECT_NEAR(glm::length(p.at(s, joint) - p.at(s, hanim_parent(joint))), rest, 2e-5f);
  }
}

TEST(Pose, RefusesWhatItCannotDo) {
  const Skeleton s = default_skeleton();
  const BapFrame f;
  std::vector<Affine> out(kHanimJointCount - 1);
  EXPECT_EQ((PoseJob{.skeleton = &s, .baps = &f, .out = out}).run().code, Code::out_of_capacity);
  EXPECT_EQ((PoseJob{.baps = &f, .out = out}).run().code, Code::invalid_argument);
}

TEST(Skeleton, UprightLegsAreVertical) {
  const Skeleton s = upright_skeleton();
  for (const HanimJoint j : {HanimJoint::l_knee, HanimJoint::l_ankle, HanimJoint::r_ankle})
    EXPECT_NEAR(s.center(j).z, s.center(HanimJoint::l_hip).z, 1e-6f);
  EXPECT_NEAR(s.center(HanimJoint::l_hip).y, 0.927f, 1e-4f);
}

TEST(Calibration, NothingSentChangesNothing) {
  const Skeleton s = upright_skeleton();
  Skeleton out;
  CalibrationReport report;
  ASSERT_TRUE(calibrate(s, {}, out, report).ok());
  for (std::size_t j = 0; j < kHanimJointCount; ++j) expect_near(out.center_m[j], s.center_m[j]);
}

TEST(Calibration, LongerLegsCarryFeetAndSoles) {
  const Skeleton s = upright_skeleton();
  std::vector<JointCenter> sent;
  for (const HanimJoint j : {HanimJoint::humanoid_root, HanimJoint::skullbase, HanimJoint::l_hip,
                             HanimJoint::l_knee, HanimJoint::l_ankle})
    sent.push_back({j, s.center(j) * 1.1f});
  Skeleton out;
  CalibrationReport report;
  ASSERT_TRUE(calibrate(s, sent, out, report).ok());
  EXPECT_EQ(report.given, 5);
  EXPECT_NEAR(report.largest_scale, 1.1f, 1e-4f);
  expect_near(out.center(HanimJoint::vt6), s.center(HanimJoint::vt6) * 1.1f, 2e-3f);
  expect_near(out.center(HanimJoint::l_metatarsal), s.center(HanimJoint::l_metatarsal) * 1.1f,
              1e-4f);
}

TEST(Calibration, RefusesNonsense) {
  const Skeleton s = upright_skeleton();
  Skeleton out;
  CalibrationReport report;
  const JointCenter twice[] = {{HanimJoint::l_hip, {0.1f, 0.9f, 0}}, {HanimJoint::l_hip, {}}};
  EXPECT_EQ(calibrate(s, twice, out, report).detail, 1);
  const JointCenter infinite[] = {{HanimJoint::l_hip, {0.1f, INFINITY, 0}}};
  EXPECT_EQ(calibrate(s, infinite, out, report).detail, 2);
  const JointCenter giant[] = {{HanimJoint::skullbase, {0, 4.0f, 0}}};
  EXPECT_EQ(calibrate(s, giant, out, report).detail, 3);
  const JointCenter stretched[] = {{HanimJoint::l_shoulder, s.center(HanimJoint::l_shoulder)},
                                   {HanimJoint::l_elbow, {0.2f, 1.44f, 0}}};
  EXPECT_EQ(calibrate(s, stretched, out, report).detail, 4);
}

}  // namespace
}  // namespace caryatid::body
