#include "assets/bake/face/follow.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace caryatid::bake::fat {
namespace {

// Barycentric coordinates of the point of a triangle closest to p (Ericson 2005, 5.1.5).
Vec3 closest(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp),
              d4 = glm::dot(ac, bp), d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d3 / (d3 - d1), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {d6 / (d6 - d2), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const float t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  return Vec3(va, vb, vc) / (va + vb + vc);
}

Carrier beneath(const Head& head, Vec3 p) {
  Carrier best;
  float least = 1e9f;
  for (const auto& t : head.skin.triangles) {
    if (head.eye[0].inside[t[0]] || head.eye[1].inside[t[0]]) continue;
    const Vec3 a = head.skin.position_m[t[0]], b = head.skin.position_m[t[1]],
               c = head.skin.position_m[t[2]];
    if (glm::length(a - p) > 0.04f) continue;  // No triangle of a face is that large.
    const Vec3 w = closest(p, a, b, c);
    const float d = glm::length(w.x * a + w.y * b + w.z * c - p);
    if (d >= least) continue;
    least = d;
    best.skin = {t[0], t[1], t[2], t[0]};
    best.weight = {w.x, w.y, w.z, 0};
  }
  return best;
}

// Connected parts of a mesh: the label of each vertex. Vertices at one place count as one.
std::vector<std::uint32_t> components(const Mesh& mesh) {
  std::vector<std::uint32_t> label(mesh.position_m.size());
  std::iota(label.begin(), label.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (label[v] != v) v = label[v] = label[label[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 1; i < 3; ++i) label[root(t[i])] = root(t[0]);
  for (std::uint32_t v = 0; v < label.size(); ++v) label[v] = root(v);
  return label;
}

float angle_of(Vec3 p, Vec3 center) { return std::atan2(p.y - center.y, p.z - center.z); }

}  // namespace

Carriers carriers_of_brow(const Head& head, const Mesh& mesh) {
  Carriers out;
  // A brow is narrow and keeps its breadth: its hairs go mostly with the skin on the brow's line,
  // also where the skin beneath them lags behind (near the lid, towards the hair line).
  constexpr float kOwnSkin = 0.3f;
  for (Vec3 p : mesh.position_m) {
    const float line = brow_line_m(head, head.lateral(p, 0) > 0.0f ? 0 : 1, p);
    p.y = glm::mix(line, p.y, kOwnSkin);
    out.push_back(beneath(head, p));
  }
  return out;
}

Carriers carriers_of_lash(const Head& head, const Mesh& mesh) {
  const std::vector<std::uint32_t> part = components(mesh);
  // A strip of lashes belongs to the lid that its closest vertex touches.
  struct Owner {
    float distance_m = 1e9f;
    int eye = 0;
    bool upper = true;
  };
  std::vector<Owner> owner(mesh.position_m.size());
  for (std::uint32_t i = 0; i < part.size(); ++i)
    for (int e = 0; e < kSides; ++e)
      for (const bool upper : {true, false}) {
        const Eye& eye = head.eye[static_cast<std::size_t>(e)];
        for (const std::uint32_t v : upper ? eye.upper : eye.lower) {
          const float d = glm::length(head.skin.position_m[v] - mesh.position_m[i]);
          if (d < owner[part[i]].distance_m) owner[part[i]] = {d, e, upper};
        }
      }
  Carriers out;
  for (std::uint32_t i = 0; i < part.size(); ++i) {
    const Owner& of = owner[part[i]];
    const Eye& eye = head.eye[static_cast<std::size_t>(of.eye)];
    // Beside it as seen from the eyeball's centre: lashes fan out from there.
    const auto& rim = of.upper ? eye.upper : eye.lower;
    const auto bearing = [&](Vec3 p) {
      return std::atan2(p.x - eye.center_m.x, p.z - eye.center_m.z);
    };
    const auto at = [&](std::size_t r) { return bearing(head.skin.position_m[rim[r]]); };
    const float own = bearing(mesh.position_m[i]);
    std::size_t right = 0;
    while (right < rim.size() && at(right) < own) ++right;
    const std::size_t a = right == 0 ? 0 : right - 1;
    const std::size_t b = std::min(right, rim.size() - 1);
    const float t = at(b) > at(a) ? std::clamp((own - at(a)) / (at(b) - at(a)), 0.0f, 1.0f) : 0.0f;
    Carrier carrier;
    carrier.skin = {rim[a], rim[b], rim[a], rim[a]};
    carrier.weight = {1.0f - t, t, 0.0f, 0.0f};
    carrier.eye = of.eye;
    out.push_back(carrier);
  }
  return out;
}

Vec3 followed(const Head& head, const Carrier& carrier, Vec3 position_m,
              const std::vector<Vec3>& displacement) {
  Vec3 shift{0};
  for (std::size_t i = 0; i < 4; ++i) shift += carrier.weight[i] * displacement[carrier.skin[i]];
  if (carrier.eye < 0) {
    // The cards of a brow are coarser than the skin that bulges beneath them.
    constexpr float kLift = 0.10f;
    Vec3 out{0};
    for (std::size_t i = 0; i < 4; ++i) out += carrier.weight[i] * head.normal[carrier.skin[i]];
    return shift + kLift * glm::length(shift) * out;
  }
  // A lash turns with its rim about the eyeball's axis and keeps its distance from the rim.
  const Vec3 center = head.eye[static_cast<std::size_t>(carrier.eye)].center_m;
  Vec3 root{0};
  for (std::size_t i = 0; i < 4; ++i)
    root += carrier.weight[i] * head.skin.position_m[carrier.skin[i]];
  const float turn = angle_of(root + shift, center) - angle_of(root, center);
  const Vec3 arm = position_m - root;
  const float c = std::cos(turn), s = std::sin(turn);
  const Vec3 turned{arm.x, c * arm.y + s * arm.z, c * arm.z - s * arm.y};
  return shift + turned - arm;
}

}  // namespace caryatid::bake::fat
