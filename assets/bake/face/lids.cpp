// Lids (orbicularis oculi closes, levator palpebrae opens the upper one): they turn about the axis
// through the eyeball along X, so they slide on the ball. At full closure both rims lie on one
// line: FAP 19 + FAP 21 = IRISD0 shuts the eye.
#include <algorithm>
#include <cmath>

#include "assets/bake/face/follow.h"
#include "assets/bake/face/movement.h"
#include "assets/bake/face/open_lids.h"

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
};

float step(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Height of the lower edge of a brow above a point.
float under_brow(const Head& head, int side, Vec3 p) {
  constexpr float kHalfBrow_m = 0.004f;
  return brow_line_m(head, side, p) - kHalfBrow_m - p.y;
}

// Turn and growth of the rim at x, linear between its vertices, 0 at the corners.
Vec2 closing_at(const Head& head, const Eye& eye, bool upper, float x) {
  const auto& own = upper ? eye.upper : eye.lower;
  const auto& other = upper ? eye.lower : eye.upper;
  const Vec3 a = rim_at(head, own, x), b = rim_at(head, other, x);
  const float left =
      std::min(head.skin.position_m[own.front()].x, head.skin.position_m[other.front()].x);
  const float right =
      std::max(head.skin.position_m[own.back()].x, head.skin.position_m[other.back()].x);
  constexpr float kCorner_m = 0.0015f;
  const float inside =
      std::min(step((x - left) / kCorner_m + 1.0f), step((right - x) / kCorner_m + 1.0f));
  const Polar from = polar(a, eye.center_m), to = polar(b, eye.center_m);
  return inside * Vec2(to.angle_rad - from.angle_rad, to.radius_m - from.radius_m);
}

// A lid turns whole at its rim and less and less up to the edge of the orbit or the brow; a product
// of smooth steps, which cannot overshoot in the narrow strip beneath a low brow.
Closure closure_of(const Head& head, int side, bool upper) {
  const Eye& eye = head.eye[static_cast<std::size_t>(side)];
  const Skin& skin = head.skin;
  const auto& own = upper ? eye.upper : eye.lower;
  constexpr float kLid_m[2] = {0.014f, 0.016f};  // Lower, upper: to the bone of the orbit.
  constexpr float kBehind_m = 0.009f;            // The lining gives way behind the rim.
  const auto own_m = distance_m(skin, own, 0.03f);
  const auto other_m = distance_m(skin, upper ? eye.lower : eye.upper, 0.03f);
  Closure closure{std::vector<float>(skin.size(), 0.0f), std::vector<float>(skin.size(), 0.0f)};
  for (std::uint32_t v = 0; v < skin.size(); ++v) {
    if (!std::isfinite(own_m[v]) || own_m[v] > other_m[v]) continue;
    const Vec3 p = skin.position_m[v];
    float end = eye.inside[v] ? kBehind_m : kLid_m[upper ? 1 : 0];
    if (upper && !eye.inside[v])
      end = std::min(end, own_m[v] + std::max(under_brow(head, side, p), 0.0f));
    const float share = own_m[v] <= 0.0f ? 1.0f : step(1.0f - own_m[v] / std::max(end, 1e-6f));
    const Vec2 closing = closing_at(head, eye, upper, p.x);
    closure.turn[v] = share * closing.x;
    closure.growth[v] = share * closing.y;
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
    const float radius = from.radius_m + std::max(share, 0.0f) * closure.growth[v];
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
    const float radius = from.radius_m + std::max(share, 0.0f) * closure.growth[point];
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
      const Closure closure = closure_of(head, side, upper);
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

namespace {

// The lash helpers of the base, to which lashes are fitted, as a mesh whose vertices are `base_of`.
Mesh lash_helpers(const BaseHuman& base, int side, std::span<const Vec3> base_m,
                  std::vector<std::uint32_t>& base_of) {
  const std::string stem = side == 0 ? "helper-l-eyelashes" : "helper-r-eyelashes";
  Mesh mesh;
  std::vector<std::uint32_t> local(base_m.size(), kNone);
  for (const Quad& quad : base.quads()) {
    if (!base.groups()[quad.group].starts_with(stem)) continue;
    std::array<std::uint32_t, 4> q{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::uint32_t& v = local[quad.vertex[i]];
      if (v == kNone) {
        v = static_cast<std::uint32_t>(base_of.size());
        base_of.push_back(quad.vertex[i]);
        mesh.position_m.push_back(base_m[quad.vertex[i]]);
      }
      q[i] = v;
    }
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

}  // namespace

void open_lids(const BaseHuman& base, const LidPoints& points, float opening_m,
               std::vector<Vec3>& base_m) {
  Head head;
  std::vector<std::array<std::uint32_t, 4>> quads;
  const std::uint16_t body = base.group("body");
  constexpr float kNeck_m = 0.59f;  // In the base's own rest frame.
  for (const Quad& quad : base.quads())
    if (quad.group == body && base.rest_m()[quad.vertex[0]].y > kNeck_m)
      quads.push_back(quad.vertex);
  head.skin = make_skin(base_m, quads);
  for (const auto& [key, vertex] : points) {
    head.point_m[key] = base_m[vertex];
    head.point_vertex[key] = head.skin.of_base[vertex];
  }
  for (int side = 0; side < kSides; ++side) {
    Eye& eye = head.eye[static_cast<std::size_t>(side)];
    eye = find_eye(head.skin, base, side);
    const std::uint16_t ball = base.group(side == 0 ? "helper-l-eye" : "helper-r-eye");
    Vec3 low{1e9f}, high{-1e9f};
    for (const Quad& quad : base.quads())
      for (const std::uint32_t v : quad.vertex)
        if (quad.group == ball) low = glm::min(low, base_m[v]), high = glm::max(high, base_m[v]);
    eye.center_m = 0.5f * (low + high);
  }
  head.middle_x_m = 0.5f * (head.eye[0].center_m.x + head.eye[1].center_m.x);
  for (int side = 0; side < kSides; ++side) {
    const Eye& eye = head.eye[static_cast<std::size_t>(side)];
    const std::uint32_t top = head.vertex_of(3, 1 + side), bottom = head.vertex_of(3, 3 + side);
    const float wider_m =
        opening_m - (head.skin.position_m[top].y - head.skin.position_m[bottom].y);
    constexpr float kUpperShare = 0.7f;
    const Closure upper = closure_of(head, side, true), lower = closure_of(head, side, false);
    std::vector<Vec3> moved =
        turned(head, eye, upper, share_for(head, eye, upper, top, kUpperShare * wider_m));
    const std::vector<Vec3> below = turned(
        head, eye, lower, share_for(head, eye, lower, bottom, -(1.0f - kUpperShare) * wider_m));
    for (std::uint32_t v = 0; v < moved.size(); ++v) moved[v] += below[v];
    std::vector<std::uint32_t> lash_of;
    const Mesh lashes = lash_helpers(base, side, base_m, lash_of);
    const Carriers carriers = carriers_of_lash(head, lashes);
    for (std::uint32_t i = 0; i < lash_of.size(); ++i)
      base_m[lash_of[i]] += followed(head, carriers[i], lashes.position_m[i], moved);
    for (std::uint32_t v = 0; v < moved.size(); ++v) base_m[head.skin.base[v]] += moved[v];
  }
}

}  // namespace caryatid::bake::fat
