#include "assets/bake/simplify/symmetry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace caryatid::bake {

std::vector<std::uint32_t> mirror_points(std::span<const Vec3d> points, double tolerance) {
  std::vector<std::uint32_t> by_height(points.size());
  std::iota(by_height.begin(), by_height.end(), 0u);
  std::sort(by_height.begin(), by_height.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a].y != points[b].y ? points[a].y < points[b].y : a < b;
  });
  std::vector<std::uint32_t> mirror(points.size(), kNone);
  std::size_t found = 0;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const Vec3d p = mirrored(points[v]);
    double best = tolerance * tolerance;
    auto i = std::lower_bound(by_height.begin(), by_height.end(), p.y - tolerance,
                              [&](std::uint32_t a, double y) { return points[a].y < y; });
    for (; i != by_height.end() && points[*i].y <= p.y + tolerance; ++i) {
      const double d = length2(points[*i] - p);
      if (d > best || (d == best && mirror[v] != kNone)) continue;
      best = d;
      mirror[v] = *i;
    }
    found += mirror[v] != kNone;
  }
  // Pairs only: both must name each other.
  for (std::uint32_t v = 0; v < points.size(); ++v)
    if (mirror[v] != kNone && mirror[mirror[v]] != v) mirror[v] = kNone;
  if (4 * found < 3 * points.size()) std::fill(mirror.begin(), mirror.end(), kNone);
  return mirror;
}

std::vector<float> importance_from_front(const Mesh& mesh, float behind) {
  std::vector<float> out;
  for (const Vec3& n : mesh.normal) {
    const float turned = std::clamp((-0.35f - n.z) / 0.35f, 0.0f, 1.0f);
    out.push_back(1.0f + turned * (behind - 1.0f));
  }
  return out;
}

std::vector<float> importance_of_head(const Character& character, std::uint32_t head) {
  constexpr float kUnder_m = 0.008f, kCounts = 2.0f;
  const Mesh& skin = character.objects[head].mesh;
  std::vector<float> out = importance_from_front(skin);
  std::vector<bool> under(out.size(), false);
  for (const Object& o : character.objects) {
    if (o.role != pack::ObjectRole::brow && o.role != pack::ObjectRole::lash) continue;
    for (const Vec3& p : o.mesh.position_m)
      for (std::size_t v = 0; v < out.size(); ++v)
        if (length2(Vec3d(skin.position_m[v] - p)) < double{kUnder_m} * double{kUnder_m})
          under[v] = true;
  }
  for (std::size_t v = 0; v < out.size(); ++v)
    if (under[v]) out[v] *= kCounts;
  return out;
}

}  // namespace caryatid::bake
