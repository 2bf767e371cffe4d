#include "core/body/helper_joints.h"

#include <cmath>

namespace caryatid::body {
namespace {

Mat3 turn_of(const Affine& a) {
  return Mat3(a.direction({1, 0, 0}), a.direction({0, 1, 0}), a.direction({0, 0, 1}));
}

// The shorter of the two quaternions.
Quat positive(const Quat& q) { return q.w < 0.0f ? Quat(-q.w, -q.x, -q.y, -q.z) : q; }

Quat unit(const Quat& q) {
  const float n2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  if (!(n2 > 1e-12f)) return Quat(1, 0, 0, 0);
  const float s = 1.0f / std::sqrt(n2);
  return Quat(q.w * s, q.x * s, q.y * s, q.z * s);
}

// The part of a turn that is about the axis.
Quat twist_of(const Quat& q, Vec3 axis) {
  const Vec3 along = axis * (axis.x * q.x + axis.y * q.y + axis.z * q.z);
  return positive(unit(Quat(q.w, along.x, along.y, along.z)));
}

Quat half_of(const Quat& q) { return unit(Quat(q.w + 1.0f, q.x, q.y, q.z)); }

Affine about(const Quat& q, Vec3 center) {
  const Mat3 r = glm::mat3_cast(q);
  const Vec3 t = center - r * center;
  Affine out;
  for (int i = 0; i < 3; ++i) out.row[i] = {r[0][i], r[1][i], r[2][i], t[i]};
  return out;
}

Vec3 direction(Vec3 from, Vec3 to) {
  const Vec3 d = to - from;
  const float n2 = glm::dot(d, d);
  return n2 > 1e-12f ? d / std::sqrt(n2) : Vec3{0, -1, 0};
}

class Side {
 public:
  Side(const Skeleton& s, std::span<Affine> pose, bool left) : s_(s), pose_(pose), left_(left) {}

  void pose() {
    const HanimJoint shoulder = sided(HanimJoint::l_shoulder);
    const HanimJoint elbow = sided(HanimJoint::l_elbow);
    const HanimJoint wrist = sided(HanimJoint::l_wrist);
    const HanimJoint knee = sided(HanimJoint::l_knee);
    const Vec3 upper = direction(s_.center(shoulder), s_.center(elbow));
    const Vec3 lower = direction(s_.center(elbow), s_.center(wrist));
    const Quat wound = glm::conjugate(twist_of(local_turn(shoulder), upper));
    put(HelperJoint::l_upper_arm, shoulder, shoulder, wound);
    put(HelperJoint::l_upper_arm_mid, shoulder, shoulder, half_of(wound));
    const Quat turn = local_turn(elbow);
    const Quat twist = twist_of(turn, lower), hand = twist_of(local_turn(wrist), lower);
    const Quat back = glm::conjugate(twist);
    put(HelperJoint::l_elbow_half, shoulder, elbow, half_of(positive(turn * back)));
    put(HelperJoint::l_forearm_near, elbow, elbow, back);
    put(HelperJoint::l_forearm_mid, elbow, elbow, back * half_of(twist) * half_of(hand));
    put(HelperJoint::l_forearm_far, elbow, elbow, hand);
    put(HelperJoint::l_knee_half, sided(HanimJoint::l_hip), knee, half_of(local_turn(knee)));
  }

 private:
  HanimJoint sided(HanimJoint l) const { return left_ ? l : mirrored(l); }
  // Against the parent.
  Quat local_turn(HanimJoint joint) const {
    const Mat3 parent = turn_of(pose_[index_of(hanim_parent(joint))]);
    return positive(unit(glm::quat_cast(glm::transpose(parent) * turn_of(pose_[index_of(joint)]))));
  }
  // Moves with `carrier`, turned by q about the centre of `joint`.
  void put(HelperJoint helper, HanimJoint carrier, HanimJoint joint, const Quat& q) {
    pose_[index_of(helper) + (left_ ? 0u : 1u)] =
        pose_[index_of(carrier)] * about(q, s_.center(joint));
  }

  const Skeleton& s_;
  std::span<Affine> pose_;
  bool left_;
};

}  // namespace

HanimJoint helper_owner(HelperJoint joint) {
  constexpr HanimJoint kOwners[] = {
      HanimJoint::l_shoulder, HanimJoint::l_shoulder, HanimJoint::l_elbow, HanimJoint::l_elbow,
      HanimJoint::l_elbow,    HanimJoint::l_elbow,    HanimJoint::l_knee};
  const auto i = static_cast<std::size_t>(joint);
  return i % 2 == 0 ? kOwners[i / 2] : mirrored(kOwners[i / 2]);
}

Status pose_helpers(const Skeleton& skeleton, std::span<Affine> io_pose) {
  if (io_pose.size() != kSkinJointCount) return {Code::invalid_argument};
  for (const bool left : {true, false}) Side(skeleton, io_pose, left).pose();
  return {};
}

}  // namespace caryatid::body
