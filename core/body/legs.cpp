#include "core/body/legs.h"

#include "core/base/trig.h"
#include "core/body/ik.h"

namespace caryatid::body {
namespace {

// Rotations in the order ankle flexion (X), ankle twisting (Y), subtalar (Z).
struct AnkleTurns {
  float x, y, z;
};
AnkleTurns ankle_turns(const Mat3& r) {
  return {atan2_of(-r[2][1], r[2][2]), asin_of(r[2][0]), atan2_of(-r[1][0], r[0][0])};
}

Mat3 pelvis_rotation(const LowerBody& body) {
  return rotation_y(body.torsion_rad) * rotation_z(body.roll_rad);
}

Vec3 hips_at_rest(const Skeleton& s) {
  return 0.5f * (s.center(HanimJoint::l_hip) + s.center(HanimJoint::r_hip));
}

// Offset of a hip from hips_m in the frame of the body's heading.
Vec3 hip_offset(const Skeleton& s, const Mat3& pelvis, bool left) {
  const Vec3 c = s.center(HanimJoint::sacroiliac);
  return c + pelvis * (s.center(leg(left).upper) - c) - hips_at_rest(s);
}

float pose_leg(const Skeleton& s, const LowerBody& body, const Mat3& world_pelvis, bool left,
               BapFrame& out) {
  const Limb& limb = leg(left);
  const FootTarget& target = body.foot[left ? 0 : 1];
  const HanimJoint subtalar = left ? HanimJoint::l_subtalar : HanimJoint::r_subtalar;
  const HanimJoint toes = left ? HanimJoint::l_metatarsal : HanimJoint::r_metatarsal;
  const Mat3 foot = rotation_y(target.yaw_rad) * rotation_x(-target.pitch_rad);
  const Mat3 into_pelvis = glm::transpose(world_pelvis);
  const Vec3 hip = hip_position(s, body, left);
  const Vec3 axis = into_pelvis * rotation_y(target.yaw_rad)[0];
  const Vec3 lever = s.center(subtalar) - s.center(limb.end);
  Vec3 ankle = target.ankle_m;
  LimbPose pose;
  AnkleTurns turns{};
  // The sole tilts sideways about the subtalar joint, not the ankle: two rounds settle its shift.
  for (int round = 0; round < 3; ++round) {
    pose = solve_limb(s, limb, {.reach_m = into_pelvis * (ankle - hip), .hinge_axis = axis});
    const Mat3 shank = world_pelvis * pose.upper * rotation_x(pose.hinge_rad);
    turns = ankle_turns(glm::transpose(shank) * foot);
    const Mat3 above = shank * rotation_x(turns.x) * rotation_y(turns.y);
    ankle = target.ankle_m + (foot - above) * lever;
  }
  const EulerXzy hip_turns = euler_xzy(pose.upper);
  set_turn(out, limb.upper, Axis::x, hip_turns.x);
  set_turn(out, limb.upper, Axis::z, hip_turns.z);
  set_turn(out, limb.upper, Axis::y, hip_turns.y);
  set_turn(out, limb.hinge, Axis::x, pose.hinge_rad);
  set_turn(out, limb.hinge, Axis::y, 0.0f);
  set_turn(out, limb.end, Axis::x, turns.x);
  set_turn(out, limb.end, Axis::y, turns.y);
  set_turn(out, subtalar, Axis::z, turns.z);
  set_turn(out, toes, Axis::x, -target.toe_extension_rad);
  return pose.missed_m;
}

}  // namespace

Vec3 hip_position(const Skeleton& s, const LowerBody& body, bool left) {
  return body.hips_m + rotation_y(body.heading_rad) * hip_offset(s, pelvis_rotation(body), left);
}

float pose_lower_body(const Skeleton& s, const LowerBody& body, BapFrame& out) {
  const Mat3 heading = rotation_y(body.heading_rad);
  const Vec3 root = s.center(HanimJoint::humanoid_root);
  const Vec3 shift = (body.hips_m - root - heading * (hips_at_rest(s) - root)) * 1000.0f;
  out.set(181, shift.y);
  out.set(182, shift.x);
  out.set(183, shift.z);
  out.set(184, body.heading_rad * 1e5f);
  out.set(185, 0.0f);
  out.set(186, 0.0f);
  set_turn(out, HanimJoint::sacroiliac, Axis::x, 0.0f);
  set_turn(out, HanimJoint::sacroiliac, Axis::y, body.torsion_rad);
  set_turn(out, HanimJoint::sacroiliac, Axis::z, body.roll_rad);
  const Mat3 pelvis = heading * pelvis_rotation(body);
  const float left = pose_leg(s, body, pelvis, true, out);
  const float right = pose_leg(s, body, pelvis, false, out);
  return left > right ? left : right;
}

}  // namespace caryatid::body
