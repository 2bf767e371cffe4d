#include "assets/bake/simplify/distance.h"

#include <algorithm>
#include <cmath>

#include "assets/bake/simplify/vertex_blend.h"
#include "core/base/random.h"

namespace caryatid::bake {
namespace {

constexpr std::uint32_t kLeaf = 4;
// A mean over 2500 samples is good to 2 % only, as much as simplifiers differ by; this many, to
// half.
constexpr double kLeastSamples = 30000;

double unit(Random& random) { return (random.next() + 0.5) / 4294967296.0; }

}  // namespace

SurfaceTree::SurfaceTree(const Surface& surface) {
  for (const Triangle& t : surface.triangles)
    triangles_.push_back({surface.position[t[0]], surface.position[t[1]], surface.position[t[2]]});
  nodes_.push_back({});
  if (!triangles_.empty()) build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

void SurfaceTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Vec3d low{1e300}, high{-1e300};
  for (std::uint32_t t = first; t < first + count; ++t)
    for (const Vec3d& p : triangles_[t]) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  nodes_[node] = {low, high, first, count};
  if (count <= kLeaf) return;
  const Vec3d size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const auto& a, const auto& b) {
    return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = child;
  nodes_[node].count = 0;
  build(child, first, count / 2);
  build(child + 1, first + count / 2, count - count / 2);
}

double SurfaceTree::distance2(const Node& node, const Vec3d& p) const {
  return length2(p - glm::clamp(p, node.low, node.high));
}

double SurfaceTree::distance(const Vec3d& p, double bound) const {
  double best = bound < 1e150 ? bound * bound : 1e300;
  std::array<std::pair<double, std::uint32_t>, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {distance2(nodes_[0], p), 0};
  while (depth > 0) {
    const auto [d, index] = stack[--depth];
    if (d >= best) continue;
    const Node& node = nodes_[index];
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
      const auto& c = triangles_[t];
      const std::array<double, 3> w = closest_on_triangle(p, c[0], c[1], c[2]);
      best = std::min(best, length2(p - (w[0] * c[0] + w[1] * c[1] + w[2] * c[2])));
    }
    if (node.count > 0) continue;
    std::pair<double, std::uint32_t> near{distance2(nodes_[node.first], p), node.first};
    std::pair<double, std::uint32_t> far{distance2(nodes_[node.first + 1], p), node.first + 1};
    if (far < near) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return std::sqrt(best);
}

double SurfaceError::rms() const {
  return std::sqrt(0.5 * (forward.rms * forward.rms + backward.rms * backward.rms));
}

OneSided one_sided(const Surface& from, const SurfaceTree& to, double samples_per_face,
                   std::uint64_t seed) {
  std::vector<double> area(from.triangles.size() + 1, 0.0);
  for (std::size_t t = 0; t < from.triangles.size(); ++t) {
    const Vec3d& a = from.position[from.triangles[t][0]];
    area[t + 1] = area[t] + glm::length(cross(from.position[from.triangles[t][1]] - a,
                                              from.position[from.triangles[t][2]] - a));
  }
  const auto n = static_cast<std::size_t>(
      std::max(kLeastSamples, samples_per_face * static_cast<double>(from.triangles.size())));
  Random random(seed);
  OneSided out;
  std::size_t t = 0;
  for (std::size_t i = 0; i < n; ++i) {  // Stratified: one sample in each n-th of the area.
    const double at =
        (static_cast<double>(i) + unit(random)) / static_cast<double>(n) * area.back();
    while (t + 1 < from.triangles.size() && area[t + 1] < at) ++t;
    const double u = std::sqrt(unit(random)), v = unit(random);
    const Triangle& c = from.triangles[t];
    const double d = to.distance((1 - u) * from.position[c[0]] + u * (1 - v) * from.position[c[1]] +
                                 u * v * from.position[c[2]]);
    out.mean += d;
    out.rms += d * d;
    out.max = std::max(out.max, d);
  }
  out.mean /= static_cast<double>(n);
  out.rms = std::sqrt(out.rms / static_cast<double>(n));
  for (const Vec3d& p : from.position) out.max = std::max(out.max, to.distance(p));
  return out;
}

SurfaceError measure_error(const Surface& a, const Surface& b, double samples_per_face,
                           std::uint64_t seed) {
  return {one_sided(a, SurfaceTree(b), samples_per_face, seed),
          one_sided(b, SurfaceTree(a), samples_per_face, seed + 1)};
}

}  // namespace caryatid::bake
