// Lids (orbicularis oculi closes, levator palpebrae opens the upper one): they turn about the axis
// through the eyeball along X, so they slide on the ball. At full closure both rims lie on one
// line: FAP 19 + FAP 21 = IRISD0 shuts the eye.
#include <algorithm>
#include <cmath>
#include <limits>

#include "assets/bake/face/movement.h"
#include "assets/bake/face/smooth.h"

namespace caryatid::bake::fat {
namespace {

struct Polar {
  float angle_rad = 0, radius_m = 0;
};
Polar polar(Vec3 p, Vec3 center) {
  const float y = p.y - center.y, z = p.z - center.z;
  return {std::atan2(y, z), std::sqrt(y * y + z * z)};
}

// Point of a rim (ascending x) at the given x.
Vec3 rim_at(const Head& head, const std::vector<std::uint32_t>& rim, float x) {
  const auto p = [&](std::size_t i) { return head.skin.position_m[rim[i]]; };
  if (x <= p(0).x) return p(0);
  for (std::size_t i = 1; i < rim.size(); ++i) {
    if (x > p(i).x) continue;
    const float t = (x - p(i - 1).x) / std::max(p(i).x - p(i - 1).x, 1e-9f);
    return glm::mix(p(i - 1), p(i), t);
  }
  return p(rim.size() - 1);
}

// Turn (rad, positive upwards) and growth of the radius that bring every vertex of a lid to where
// the rims meet.
struct Closure {
  std::vector<float> turn, growth;
  std::vector<std::uint32_t> moved;
};

Closure closure_of(const Head& head, const Eye& eye, bool upper) {
  const Skin& skin = head.skin;
  const auto& own = upper ? eye.upper : eye.lower;
  const auto& other = upper ? eye.lower : eye.upper;
  std::vector<std::uint32_t> given = eye.rim;
  std::vector<Vec3> value(given.size(), Vec3(0));
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (std::find(own.begin(), own.end(), given[i]) == own.end()) continue;
    const Vec3 p = skin.position_m[given[i]];
    const Polar from = polar(p, eye.center_m), to = polar(rim_at(head, other, p.x), eye.center_m);
    // Beyond the corners of the other rim there is nothing to meet: fade to the corner.
    value[i] = {to.angle_rad - from.angle_rad, to.radius_m - from.radius_m, 0};
  }
  constexpr float kLidHeight_m[2] = {0.014f, 0.017f};  // Lower, upper: to the bone of the orbit.
  const auto own_m = distance_m(skin, own, 0.03f), other_m = distance_m(skin, other, 0.03f);
  const float brow = upper ? std::min(head.place_of(4, 1).y, head.place_of(4, 5).y) : 1e9f;
  for (std::uint32_t v = 0; v < skin.size(); ++v) {
    if (std::find(eye.rim.begin(), eye.rim.end(), v) != eye.rim.end()) continue;
    const bool far = !(own_m[v] < (eye.inside[v] ? 0.009f : kLidHeight_m[upper ? 1 : 0]));
    if (!far && own_m[v] <= other_m[v] && skin.position_m[v].y < brow - 0.002f) continue;
    given.push_back(v);
    value.push_back(Vec3(0));
  }
  const std::vector<Vec3> solved = SmoothFields(skin, given).solve(value);
  Closure closure;
  for (const Vec3& s : solved) {
    // No part of a lid turns farther than its rim or backwards.
    closure.turn.push_back(upper ? std::min(s.x, 0.0f) : std::max(s.x, 0.0f));
    closure.growth.push_back(s.y);
  }
  return closure;
}

std::vector<Vec3> turned(const Head& head, const Eye& eye, const Closure& closure, float share) {
  std::vector<Vec3> out(head.skin.size(), Vec3(0));
  for (std::uint32_t v = 0; v < head.skin.size(); ++v) {
    if (closure.turn[v] == 0.0f && closure.growth[v] == 0.0f) continue;
    const Vec3 p = head.skin.position_m[v];
    const Polar from = polar(p, eye.center_m);
    const float angle = from.angle_rad + share * closure.turn[v];
    // On its way over the cornea a lid is pushed out a little where it is tight on the ball.
    float radius = from.radius_m + share * closure.growth[v];
    out[v] = Vec3(p.x, eye.center_m.y + radius * std::sin(angle),
                  eye.center_m.z + radius * std::cos(angle)) -
             p;
  }
  return out;
}

// Share of the closure at which the feature point has moved by `amount_m` upwards.
float share_for(const Head& head, const Eye& eye, const Closure& closure, std::uint32_t point,
                float amount_m) {
  const Polar from = polar(head.skin.position_m[point], eye.center_m);
  const auto lift = [&](float share) {
    const float radius = from.radius_m + share * closure.growth[point];
    return radius * std::sin(from.angle_rad + share * closure.turn[point]) -
           from.radius_m * std::sin(from.angle_rad);
  };
  float low = -1.5f, high = 2.0f;
  const bool rising = lift(1.0f) > 0.0f;
  for (int i = 0; i < 40; ++i) {
    const float middle = 0.5f * (low + high);
    ((lift(middle) < amount_m) == rising ? low : high) = middle;
  }
  return 0.5f * (low + high);
}

}  // namespace

void add_lids(const Head& head, const ReachOf& reach, std::vector<Movement>& out) {
  for (int side = 0; side < kSides; ++side) {
    const Eye& eye = head.eye[static_cast<std::size_t>(side)];
    for (const bool upper : {true, false}) {
      const int fap = (upper ? 19 : 21) + side;
      const std::uint32_t point = head.vertex_of(3, (upper ? 1 : 3) + side);
      const Closure closure = closure_of(head, eye, upper);
      const auto field = [&](float closing_m) {
        const float lift = upper ? -closing_m : closing_m;
        return turned(head, eye, closure, share_for(head, eye, closure, point, lift));
      };
      const Range range = reach(fap);
      add_movements(head, fap, {0, range.high}, upper ? 6 : 2, field, out);
      add_movements(head, fap, {range.low, 0}, 2, field, out);
    }
  }
}

}  // namespace caryatid::bake::fat
