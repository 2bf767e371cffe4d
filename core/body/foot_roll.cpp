#include "core/body/foot_roll.h"

#include <cmath>

#include "core/base/trig.h"

namespace caryatid::body {
namespace {

// Turns (z, y) by `rad`, toe up positive.
Vec2 turned(Vec2 v, SinCos t) { return {v.x * t.cos - v.y * t.sin, v.x * t.sin + v.y * t.cos}; }

// min(x, limit) with the corner rounded over +-width.
float soft_limit(float x, float limit, float width) {
  if (x <= limit - width) return x;
  if (x >= limit + width) return limit;
  const float over = x - (limit - width);
  return x - over * over / (4.0f * width);
}

float min_of(float a, float b) { return a < b ? a : b; }

}  // namespace

FootShape foot_shape(const Skeleton& skeleton, bool left) {
  const Vec3 ankle = skeleton.center(left ? HanimJoint::l_ankle : HanimJoint::r_ankle);
  const Vec3 ball = skeleton.center(left ? HanimJoint::l_metatarsal : HanimJoint::r_metatarsal);
  const Sole& sole = skeleton.sole[left ? 0 : 1];
  const auto from_ankle = [&](Vec2 p) { return Vec2{p.x - ankle.z, p.y}; };
  return {.ankle = {0.0f, ankle.y},
          .metatarsal = from_ankle({ball.z, ball.y}),
          .heel_back = from_ankle(sole.heel_back),
          .heel = from_ankle(sole.heel),
          .ball = from_ankle(sole.ball),
          .toe = from_ankle(sole.toe),
          .toe_tip = from_ankle(sole.toe_tip)};
}

namespace {

// Rolls a rigid outline over `near` and then, when the edge from there to `far` lies on the floor,
// over `far`. `tilt_rad`: how far it is tipped towards `far`; `toe_up` +1 when that is toe up.
Vec2 rolled(Vec2 point, Vec2 near, Vec2 far, float tilt_rad, float toe_up) {
  const SinCos t = sin_cos(tilt_rad * toe_up);
  const Vec2 edge = far - near;
  const float length_m = std::sqrt(edge.x * edge.x + edge.y * edge.y);
  const float slope = atan2_of(edge.y, -toe_up * edge.x);
  if (tilt_rad <= slope || length_m < 1e-5f) return near + turned(point - near, t);
  return Vec2{near.x - toe_up * length_m, 0.0f} + turned(point - far, t);
}

}  // namespace

FootRoll roll_foot(const FootShape& shape, float pitch_rad, float toe_bend_rad) {
  if (pitch_rad >= 0.0f)
    return {.ankle = rolled(shape.ankle, shape.heel, shape.heel_back, pitch_rad, 1.0f)};
  const float down = -pitch_rad;
  const float bend = soft_limit(down, toe_bend_rad, 0.25f * toe_bend_rad);
  const Vec2 joint = rolled(shape.metatarsal, shape.toe, shape.toe_tip, down - bend, -1.0f);
  return {.ankle = joint + turned(shape.ankle - shape.metatarsal, sin_cos(pitch_rad)),
          .toe_extension_rad = bend};
}

float lowest_point(const FootShape& shape, Vec2 ankle, float pitch_rad, float toe_extension_rad) {
  const SinCos hind = sin_cos(pitch_rad);
  const SinCos front = sin_cos(pitch_rad + toe_extension_rad);
  const Vec2 joint = ankle + turned(shape.metatarsal - shape.ankle, hind);
  float low = ankle.y + turned(shape.heel_back - shape.ankle, hind).y;
  low = min_of(low, ankle.y + turned(shape.heel - shape.ankle, hind).y);
  if (toe_extension_rad <= 0.0f)  // With bent toes the skin of the ball goes with them.
    low = min_of(low, ankle.y + turned(shape.ball - shape.ankle, hind).y);
  low = min_of(low, joint.y + turned(shape.toe - shape.metatarsal, front).y);
  return min_of(low, joint.y + turned(shape.toe_tip - shape.metatarsal, front).y);
}

}  // namespace caryatid::body
