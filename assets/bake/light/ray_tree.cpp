#include "assets/bake/light/ray_tree.h"

#include <algorithm>
#include <cmath>

namespace caryatid::bake {
namespace {

constexpr std::uint32_t kLeafSize = 4;

float center(const RayTree::Triangle& t, int axis) {
  return t.corner[0][axis] + t.corner[1][axis] + t.corner[2][axis];
}

bool meets_box(Vec3 low, Vec3 high, Vec3 origin, Vec3 inverse, float reach) {
  float enter = 0.0f, leave = reach;
  for (int a = 0; a < 3; ++a) {
    const float t0 = (low[a] - origin[a]) * inverse[a], t1 = (high[a] - origin[a]) * inverse[a];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return enter <= leave;
}

// Distance along the ray, or a negative number (Moeller-Trumbore 1997).
float meets_triangle(const RayTree::Triangle& t, Vec3 origin, Vec3 direction) {
  const Vec3 ab = t.corner[1] - t.corner[0], ac = t.corner[2] - t.corner[0];
  const Vec3 p = glm::cross(direction, ac);
  const float det = glm::dot(ab, p);
  if (std::abs(det) < 1e-14f) return -1.0f;
  const Vec3 s = origin - t.corner[0];
  const float u = glm::dot(s, p) / det;
  if (u < 0.0f || u > 1.0f) return -1.0f;
  const Vec3 q = glm::cross(s, ab);
  const float v = glm::dot(direction, q) / det;
  if (v < 0.0f || u + v > 1.0f) return -1.0f;
  return glm::dot(ac, q) / det;
}

}  // namespace

RayTree::RayTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  nodes_.reserve(triangles_.size() + 1);
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void RayTree::build(std::uint32_t first, std::uint32_t count) {
  Node node{Vec3{1e30f}, Vec3{-1e30f}, first, count};
  for (std::uint32_t i = first; i < first + count; ++i)
    for (const Vec3& c : triangles_[i].corner) {
      node.low = glm::min(node.low, c);
      node.high = glm::max(node.high, c);
    }
  const std::size_t at = nodes_.size();
  nodes_.push_back(node);
  if (count <= kLeafSize) return;
  const Vec3 size = node.high - node.low;
  const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(
      begin, begin + count / 2, begin + count,
      [axis](const Triangle& a, const Triangle& b) { return center(a, axis) < center(b, axis); });
  build(first, count / 2);
  nodes_[at].count = 0;
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

RayTree::Hit RayTree::first_hit(Vec3 origin_m, Vec3 direction, float reach_m) const {
  Hit hit{reach_m, 0.0f};
  if (nodes_.empty()) return hit;
  Vec3 inverse;
  for (int a = 0; a < 3; ++a)
    inverse[a] = 1.0f / (std::abs(direction[a]) > 1e-9f ? direction[a] : 1e-9f);
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (!meets_box(node.low, node.high, origin_m, inverse, hit.distance_m)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const float t = meets_triangle(triangles_[i], origin_m, direction);
      if (t > 0.0f && t < hit.distance_m) hit = {t, triangles_[i].opacity};
    }
  }
  return hit;
}

}  // namespace caryatid::bake
