#include "core/body/gesture.h"

#include <array>
#include <cmath>

#include "core/base/trig.h"
#include "core/body/ik.h"
#include "core/body/pose.h"
#include "core/body/upper_body.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = kPi / 180.0f;
constexpr float kRiseS = 0.45f, kFallS = 0.55f, kYieldS = 0.3f;
constexpr float kWaveHz = 1.9f;

float smooth(float x) {
  if (x <= 0.0f) return 0.0f;
  if (x >= 1.0f) return 1.0f;
  return x * x * (3.0f - 2.0f * x);
}
float clamped(float x, float low, float high) { return x < low ? low : (x > high ? high : x); }

// What an arm should do; directions and places relative to its shoulder, in posed space.
struct ArmWish {
  Vec3 wrist_m{0};     // From the shoulder joint.
  Vec3 elbow_side{0};  // Where the elbow should be, as seen from the line shoulder-wrist.
  Vec3 palm{0};        // Where the palm should face.
  float finger_rad = 0.15f, index_rad = 0.15f;
};

// Writes the arm BAPs of the wish into `out`.
void pose_arm(const Skeleton& s, const Mat3& parent, bool left, const ArmWish& wish,
              BapFrame& out) {
  const Limb& limb = arm(left);
  const Mat3 into = glm::transpose(parent);
  // The elbow bends about -X: its point lies on the side of axis x reach.
  const Vec3 axis = glm::cross(wish.wrist_m, wish.elbow_side);
  const LimbPose pose =
      solve_limb(s, limb, {.reach_m = into * wish.wrist_m, .hinge_axis = into * axis});
  const EulerXzy turns = euler_xzy(pose.upper);
  set_turn(out, limb.upper, Axis::x, turns.x);
  set_turn(out, limb.upper, Axis::z, turns.z);
  set_turn(out, limb.upper, Axis::y, turns.y);
  set_turn(out, limb.hinge, Axis::x, pose.hinge_rad);
  // Turn the forearm until the palm faces as wished; at rest the palm faces the body.
  const Mat3 forearm = parent * pose.upper * rotation_x(pose.hinge_rad);
  const Vec3 palm = glm::transpose(forearm) * wish.palm;
  const float inward = left ? -1.0f : 1.0f;
  const float twist = atan2_of(-palm.z * inward, palm.x * inward);
  set_turn(out, limb.hinge, Axis::y, clamped(twist, -2.0f, 2.0f));
  set_turn(out, limb.end, Axis::x, 0.0f);
  set_turn(out, limb.end, Axis::y, 0.0f);
  set_turn(out, limb.end, Axis::z, 0.0f);
  curl_hand(out, left, wish.finger_rad, 0.5f * wish.finger_rad);
  for (int k = 0; k < 3; ++k) {
    const auto joint = static_cast<HanimJoint>(index_of(HanimJoint::l_index1) +
                                               static_cast<std::size_t>(2 * k) + (left ? 0u : 1u));
    set_turn(out, joint, Axis::z, left ? -wish.index_rad : wish.index_rad);
  }
}

ArmWish wave_wish(float side, float reach_m, float t, float size) {
  const float swing = sin_of(2.0f * kPi * kWaveHz * t) * smooth((t - 0.3f) / 0.3f);
  ArmWish w;
  w.wrist_m = reach_m * Vec3{side * (0.34f + 0.14f * size * swing), 0.26f, 0.42f};
  w.elbow_side = {side * 0.6f, -1.0f, -0.2f};
  w.palm = {side * -0.12f, 0.05f, 1.0f};
  w.finger_rad = w.index_rad = 0.06f;
  return w;
}

ArmWish beat_wish(float side, float reach_m, float t, float size) {
  // One stroke: up with the rise, down quickly, a small rebound.
  const float stroke = smooth((t - 0.25f) / 0.15f) - 0.4f * smooth((t - 0.45f) / 0.3f);
  ArmWish w;
  w.wrist_m = reach_m * Vec3{side * 0.16f, -0.42f - 0.16f * size * stroke, 0.56f};
  w.elbow_side = {side * 0.5f, -0.4f, -1.0f};
  w.palm = {side * -0.6f, 0.9f, 0.1f};
  w.finger_rad = w.index_rad = 0.32f;
  return w;
}

ArmWish shrug_wish(float side, float reach_m, float size) {
  ArmWish w;
  w.wrist_m = reach_m * Vec3{side * (0.32f + 0.12f * size), -0.42f, 0.42f};
  w.elbow_side = {side * -0.1f, -1.0f, -0.5f};
  w.palm = {side * 0.15f, 1.0f, 0.5f};
  w.finger_rad = w.index_rad = 0.12f;
  return w;
}

ArmWish point_wish(float side, float reach_m, Vec3 from_shoulder) {
  const float m = std::sqrt(glm::dot(from_shoulder, from_shoulder));
  ArmWish w;
  w.wrist_m = (m > 0.05f ? from_shoulder / m : Vec3{0, 0, 1}) * (0.93f * reach_m);
  w.elbow_side = {side * 0.6f, -1.0f, -0.4f};
  w.palm = {side * -0.7f, -0.7f, 0.0f};
  w.finger_rad = 1.25f;
  w.index_rad = 0.03f;
  return w;
}

void add_neck(BapFrame& io, Axis axis, float rad) {
  constexpr std::size_t kFirst = index_of(HanimJoint::vc7);
  constexpr std::size_t kCount = index_of(HanimJoint::skullbase) - kFirst + 1;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto joint = static_cast<HanimJoint>(kFirst + i);
    set_turn(io, joint, axis, get_turn(io, joint, axis) + rad / float(kCount));
  }
}

void blend_over(const BapFrame& gesture, float weight, BapFrame& io) {
  for (int bap = 24; bap <= 180; ++bap) {
    if (!gesture.has(bap)) continue;
    io.set(bap, io.get(bap) + (gesture.get(bap) - io.get(bap)) * weight);
  }
}

}  // namespace

const char* gesture_name(GestureKind kind) {
  constexpr std::array<const char*, 7> kNames = {"none",  "wave",  "point", "nod",
                                                 "shake", "shrug", "beat"};
  return kNames[static_cast<std::size_t>(kind)];
}

float GestureLayer::duration_s() const {
  switch (gesture_.kind) {
    case GestureKind::wave:
      return 2.2f;
    case GestureKind::point:
      return 0.6f + gesture_.hold_s;
    case GestureKind::nod:
      return 1.1f;
    case GestureKind::shake:
      return 1.3f;
    case GestureKind::shrug:
      return 1.1f;
    case GestureKind::beat:
      return 0.85f;
    default:
      return 0.0f;
  }
}

void GestureLayer::start(const Gesture& gesture) {
  next_ = gesture;
  next_.size = clamped(gesture.size, 0.3f, 1.5f);
  if (gesture_.kind != GestureKind::none) stopping_ = true;
}

void GestureLayer::stop() {
  next_ = {};
  stopping_ = gesture_.kind != GestureKind::none;
}

void GestureLayer::step(float dt_s) {
  const float dt = clamped(dt_s, 0.0f, 0.1f);
  if (gesture_.kind == GestureKind::none) {
    if (next_.kind == GestureKind::none) return;
    gesture_ = next_;
    next_ = {};
    clock_s_ = weight_ = 0.0f;
    stopping_ = false;
  }
  clock_s_ += dt;
  const bool over = clock_s_ > duration_s();
  const float rate = stopping_ ? -1.0f / kYieldS : (over ? -1.0f / kFallS : 1.0f / kRiseS);
  weight_ = clamped(weight_ + rate * dt, 0.0f, 1.0f);
  if (weight_ == 0.0f && (over || stopping_)) {
    gesture_ = {};
    stopping_ = false;
  }
}

void GestureLayer::apply(const Skeleton& s, BapFrame& io) const {
  if (gesture_.kind == GestureKind::none) return;
  const float w = smooth(weight_);
  const float t = clock_s_;
  const float size = gesture_.size;
  if (gesture_.kind == GestureKind::nod) {
    // Down twice, the second smaller.
    const float dip = 0.5f - 0.5f * cos_of(2.0f * kPi * 1.8f * t);
    add_neck(io, Axis::x, w * size * (t < 0.56f ? 15.0f : 8.0f) * kDegree * dip);
    return;
  }
  if (gesture_.kind == GestureKind::shake) {
    add_neck(io, Axis::y, w * size * 15.0f * kDegree * sin_of(2.0f * kPi * 1.7f * t));
    return;
  }
  std::array<Affine, kHanimJointCount> pose;
  if (!PoseJob{.skeleton = &s, .baps = &io, .out = pose}.run().ok()) return;
  const bool both = gesture_.kind == GestureKind::shrug;
  BapFrame wish;
  for (const bool left : {true, false}) {
    if (!both && left != gesture_.left) continue;
    const float side = left ? 1.0f : -1.0f;
    const Limb& limb = arm(left);
    const Affine& above = pose[index_of(hanim_parent(limb.upper))];
    const Mat3 parent(above.direction({1, 0, 0}), above.direction({0, 1, 0}),
                      above.direction({0, 0, 1}));
    // Wishes are made for a body that looks along +Z: the trunk's heading turns them.
    const Vec3 ahead = pose[0].direction({0, 0, 1});
    const Mat3 heading = rotation_y(atan2_of(ahead.x, ahead.z));
    const float reach_m = upper_length(s, limb) + lower_length(s, limb);
    ArmWish arm_wish;
    if (gesture_.kind == GestureKind::wave) arm_wish = wave_wish(side, reach_m, t, size);
    if (gesture_.kind == GestureKind::beat) arm_wish = beat_wish(side, reach_m, t, size);
    if (gesture_.kind == GestureKind::shrug) arm_wish = shrug_wish(side, reach_m, size);
    if (gesture_.kind == GestureKind::point) {
      const Vec3 shoulder = above.point(s.center(limb.upper));
      arm_wish =
          point_wish(side, reach_m, glm::transpose(heading) * (gesture_.target_m - shoulder));
    }
    arm_wish.wrist_m = heading * arm_wish.wrist_m;
    arm_wish.elbow_side = heading * arm_wish.elbow_side;
    arm_wish.palm = heading * arm_wish.palm;
    pose_arm(s, parent, left, arm_wish, wish);
    if (both) {
      const HanimJoint clavicle =
          left ? HanimJoint::l_sternoclavicular : HanimJoint::r_sternoclavicular;
      set_turn(wish, clavicle, Axis::z, side * 14.0f * size * kDegree);
    }
  }
  blend_over(wish, w, io);
  if (both) add_neck(io, Axis::z, w * size * 7.0f * kDegree);
}

}  // namespace caryatid::body
