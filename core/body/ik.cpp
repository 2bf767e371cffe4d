#include "core/body/ik.h"

#include <cmath>

#include "core/base/trig.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = kPi / 180.0f;

constexpr Limb kLimbs[4] = {
    {HanimJoint::l_hip, HanimJoint::l_knee, HanimJoint::l_ankle, 1.0f, 113.0f * kDegree},
    {HanimJoint::r_hip, HanimJoint::r_knee, HanimJoint::r_ankle, 1.0f, 113.0f * kDegree},
    {HanimJoint::l_shoulder, HanimJoint::l_elbow, HanimJoint::l_wrist, -1.0f, 142.0f * kDegree},
    {HanimJoint::r_shoulder, HanimJoint::r_elbow, HanimJoint::r_wrist, -1.0f, 142.0f * kDegree}};

float length(Vec3 v) { return std::sqrt(glm::dot(v, v)); }

// Right-handed orthonormal frame: first axis along `main`, second as near to `side` as can be.
Mat3 frame(Vec3 main, Vec3 side) {
  const Vec3 e1 = main / length(main);
  Vec3 e2 = side - e1 * glm::dot(side, e1);
  float e2_m = length(e2);
  if (e2_m < 1e-4f) {  // Parallel: any perpendicular.
    e2 = std::abs(e1.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    e2 = e2 - e1 * glm::dot(e2, e1);
    e2_m = length(e2);
  }
  e2 /= e2_m;
  return {e1, e2, glm::cross(e1, e2)};
}

}  // namespace

const Limb& leg(bool left) { return kLimbs[left ? 0 : 1]; }
const Limb& arm(bool left) { return kLimbs[left ? 2 : 3]; }

float upper_length(const Skeleton& s, const Limb& l) {
  return length(s.center(l.hinge) - s.center(l.upper));
}
float lower_length(const Skeleton& s, const Limb& l) {
  return length(s.center(l.end) - s.center(l.hinge));
}

LimbPose solve_limb(const Skeleton& skeleton, const Limb& limb, const LimbTarget& target) {
  const Vec3 u = skeleton.center(limb.hinge) - skeleton.center(limb.upper);
  const Vec3 v = skeleton.center(limb.end) - skeleton.center(limb.hinge);
  // The hinge turns about X: only the parts across X bend, those along it add up.
  const float a = std::sqrt(u.y * u.y + u.z * u.z);
  const float b = std::sqrt(v.y * v.y + v.z * v.z);
  const float along = u.x + v.x;
  // Angle from u to v about +X at rest; rest poses are never exactly straight.
  const float rest = atan2_of(u.y * v.z - u.z * v.y, u.y * v.y + u.z * v.z);
  LimbPose pose;
  const float distance = length(target.reach_m);
  const float across2 = distance * distance - along * along;
  const float cosine = (across2 - a * a - b * b) / (2.0f * a * b);
  pose.flexion_rad = acos_of(cosine);
  if (pose.flexion_rad > limb.hinge_max_rad) pose.flexion_rad = limb.hinge_max_rad;
  pose.hinge_rad = limb.bend * pose.flexion_rad - rest;
  const Vec3 reached = u + rotation_x(pose.hinge_rad) * v;
  pose.missed_m = std::abs(distance - length(reached));
  if (distance < 1e-6f) return pose;
  const Mat3 from = frame(reached, {1, 0, 0});
  const Mat3 to = frame(target.reach_m, target.hinge_axis);
  pose.upper = to * glm::transpose(from);
  return pose;
}

EulerXzy euler_xzy(const Mat3& r) {
  // Rx(x) Rz(z) Ry(y): first row is (cos z cos y, -sin z, cos z sin y), second column
  // (-sin z, cos x cos z, sin x cos z).
  return {.x = atan2_of(r[1][2], r[1][1]), .z = asin_of(-r[1][0]), .y = atan2_of(r[2][0], r[0][0])};
}

Mat3 rotation_x(float rad) {
  const SinCos t = sin_cos(rad);
  return {1, 0, 0, 0, t.cos, t.sin, 0, -t.sin, t.cos};
}
Mat3 rotation_y(float rad) {
  const SinCos t = sin_cos(rad);
  return {t.cos, 0, -t.sin, 0, 1, 0, t.sin, 0, t.cos};
}
Mat3 rotation_z(float rad) {
  const SinCos t = sin_cos(rad);
  return {t.cos, t.sin, 0, -t.sin, t.cos, 0, 0, 0, 1};
}

int turn_bap(HanimJoint joint, Axis axis) {
  for (const std::int16_t bap : joint_baps(joint).bap)
    if (bap != 0 && bap_axis(bap).axis == axis) return bap;
  return 0;
}

void set_turn(BapFrame& frame, HanimJoint joint, Axis axis, float rad) {
  const int bap = turn_bap(joint, axis);
  if (bap != 0) frame.set(bap, rad * 1e5f * float(bap_axis(bap).sign));
}

float get_turn(const BapFrame& frame, HanimJoint joint, Axis axis) {
  const int bap = turn_bap(joint, axis);
  return bap == 0 ? 0.0f : frame.get(bap) * 1e-5f * float(bap_axis(bap).sign);
}

}  // namespace caryatid::body
