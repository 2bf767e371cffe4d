#include "core/body/upper_body.h"

#include <cmath>

#include "core/base/trig.h"
#include "core/body/ik.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = kPi / 180.0f;
constexpr float kArmLag = 0.03f;  // Of the cycle, behind the opposite leg.

struct Range {
  HanimJoint first, last;  // In index order, down to up.
};
Range range_of(SpinePart part) {
  switch (part) {
    case SpinePart::lumbar:
      return {HanimJoint::vl5, HanimJoint::vl1};
    case SpinePart::lower_thoracic:
      return {HanimJoint::vt12, HanimJoint::vt7};
    case SpinePart::upper_thoracic:
      return {HanimJoint::vt6, HanimJoint::vt1};
    default:
      return {HanimJoint::vc7, HanimJoint::skullbase};
  }
}

// `lean_rad`: of the trunk to the left.
void pose_arm(const Skeleton& s, const GaitStyle& style, bool left, float forwardness,
              float lean_rad, BapFrame& out) {
  const Limb& limb = arm(left);
  const float side = left ? 1.0f : -1.0f;
  const float share = 0.5f + 0.5f * forwardness;  // 0 hand at the back, 1 in front.
  const auto between = [&](float back, float front) { return back + (front - back) * share; };
  // Arms hang from a bowed or leaning trunk, they do not go with it.
  const float trunk = style.trunk_pitch_deg + style.chest_pitch_deg;
  const float upper = (between(style.arm_back_deg, style.arm_forward_deg) + trunk) * kDegree;
  const float elbow = between(style.elbow_back_deg, style.elbow_forward_deg) * kDegree;
  // Where the trunk leans away the hip is in the way.
  const float lean_out = side * lean_rad > 0.0f ? side * lean_rad : 0.0f;
  const float out_rad = style.arm_out_deg * kDegree + lean_out;
  // The wrist that these angles mean, as the target: direction and distance from the shoulder.
  const Vec3 u = s.center(limb.hinge) - s.center(limb.upper);
  const Vec3 v = s.center(limb.end) - s.center(limb.hinge);
  const Mat3 shoulder = rotation_x(-upper) * rotation_z(side * out_rad);
  const Vec3 wrist = shoulder * (u + rotation_x(-elbow) * v);
  // Elbows point back and a little out; the forearm hangs inward in front of the body.
  const float inward = 0.25f + 0.45f * elbow;
  const Vec3 hinge = rotation_y(-side * inward * 0.5f) * Vec3{1, 0, 0};
  const LimbPose pose = solve_limb(s, limb, {.reach_m = wrist, .hinge_axis = hinge});
  const EulerXzy turns = euler_xzy(pose.upper);
  set_turn(out, limb.upper, Axis::x, turns.x);
  set_turn(out, limb.upper, Axis::z, turns.z);
  set_turn(out, limb.upper, Axis::y, turns.y);
  set_turn(out, limb.hinge, Axis::x, pose.hinge_rad);
  set_turn(out, limb.hinge, Axis::y, side * 0.15f);
  curl_hand(out, left, style.finger_curl_deg * kDegree, 0.5f * style.finger_curl_deg * kDegree);
}

void thrust_head(BapFrame& out, float rad) {
  constexpr int kJoints = 3;  // vc7..vc5 one way, vc2..skullbase the other.
  for (int i = 0; i < kJoints; ++i)
    for (const bool low : {true, false}) {
      const HanimJoint first = low ? HanimJoint::vc7 : HanimJoint::vc2;
      const auto joint = static_cast<HanimJoint>(index_of(first) + static_cast<std::size_t>(i));
      const float turn = rad / static_cast<float>(kJoints);
      set_turn(out, joint, Axis::x, get_turn(out, joint, Axis::x) + (low ? turn : -turn));
    }
}

}  // namespace

void turn_spine(BapFrame& out, SpinePart part, Axis axis, float rad) {
  const Range range = range_of(part);
  const std::size_t first = index_of(range.first);
  const std::size_t count = index_of(range.last) - first + 1;
  for (std::size_t i = 0; i < count; ++i)
    set_turn(out, static_cast<HanimJoint>(first + i), axis, rad / float(count));
}

void curl_hand(BapFrame& out, bool left, float finger_rad, float thumb_rad) {
  // Palms face the thighs: the left hand closes about -Z, the right about +Z.
  const HanimJoint firsts[4] = {HanimJoint::l_index1, HanimJoint::l_middle1, HanimJoint::l_ring1,
                                HanimJoint::l_pinky1};
  for (const HanimJoint first : firsts)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto joint = static_cast<HanimJoint>(index_of(first) + 2 * k + (left ? 0 : 1));
      set_turn(out, joint, Axis::z, left ? -finger_rad : finger_rad);
    }
  for (std::size_t k = 1; k < 3; ++k)
    set_turn(out, static_cast<HanimJoint>(index_of(HanimJoint::l_thumb1) + 2 * k + (left ? 0 : 1)),
             Axis::x, thumb_rad);
}

void pose_upper_body(const Skeleton& s, const GaitStyle& style, float left_phase, float slow_phase,
                     float swing, BapFrame& out) {
  const float left_arm = -cos_of(2.0f * kPi * (left_phase - kArmLag)) * swing;
  // + where the left side of the pelvis is forward.
  const float stride = cos_of(2.0f * kPi * left_phase) * swing;
  const float stance = sin_of(2.0f * kPi * left_phase) * swing;  // + over the left foot.
  const float pitch = style.trunk_pitch_deg * kDegree;
  const float chest = style.chest_pitch_deg * kDegree;
  turn_spine(out, SpinePart::lumbar, Axis::x, 0.45f * pitch);
  turn_spine(out, SpinePart::lower_thoracic, Axis::x, 0.35f * pitch + 0.5f * chest);
  turn_spine(out, SpinePart::upper_thoracic, Axis::x, 0.20f * pitch + 0.5f * chest);
  turn_spine(out, SpinePart::neck, Axis::x, style.head_pitch_deg * kDegree - pitch - chest);
  thrust_head(out, style.head_forward_deg * kDegree);
  // Left pelvis forward is a turn about -Y; the shoulders go the other way, the head stays.
  const float turn = style.shoulder_turn_deg * kDegree * stride;
  turn_spine(out, SpinePart::lumbar, Axis::y, 0.3f * turn);
  turn_spine(out, SpinePart::lower_thoracic, Axis::y, 0.4f * turn);
  turn_spine(out, SpinePart::upper_thoracic, Axis::y, 0.3f * turn);
  turn_spine(out, SpinePart::neck, Axis::y, -turn);
  const float lean = style.trunk_roll_deg * kDegree * stance;
  turn_spine(out, SpinePart::lumbar, Axis::z, -0.6f * lean);
  turn_spine(out, SpinePart::lower_thoracic, Axis::z, -0.4f * lean);
  turn_spine(out, SpinePart::upper_thoracic, Axis::z, 0.0f);
  const float head = style.head_roll_deg * kDegree * sin_of(2.0f * kPi * slow_phase) * swing;
  turn_spine(out, SpinePart::neck, Axis::z, 0.6f * lean + head);
  for (const bool left : {true, false}) {
    const float side = left ? 1.0f : -1.0f;
    const HanimJoint clavicle =
        left ? HanimJoint::l_sternoclavicular : HanimJoint::r_sternoclavicular;
    set_turn(out, clavicle, Axis::z, side * style.shoulders_up_deg * kDegree);
    set_turn(out, clavicle, Axis::y, -side * style.shoulders_forward_deg * kDegree);
    pose_arm(s, style, left, left ? left_arm : -left_arm, lean, out);
  }
}

}  // namespace caryatid::body
