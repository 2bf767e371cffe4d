#include "assets/bake/anthropometry/surface_distance.h"

#include <algorithm>
#include <limits>
#include <map>
#include <queue>

namespace caryatid::bake::anthropometry {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

}  // namespace

SkinTape::SkinTape(std::span<const Vec3> position_m,
                   std::span<const std::array<std::uint32_t, 3>> triangles)
    : position_m_(position_m), triangles_(triangles), triangles_at_(position_m.size()) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    auto& own = edges_of_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::pair<std::uint32_t, std::uint32_t> ends =
          std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      const auto [found, fresh] = number.emplace(ends, static_cast<std::uint32_t>(edges_.size()));
      if (fresh) {
        edges_.push_back({ends.first, ends.second});
        triangles_of_edge_.push_back({t, kNone});
      } else {
        triangles_of_edge_[found->second][1] = t;
      }
      own[i] = found->second;
      triangles_at_[triangles[t][i]].push_back(t);
    }
  }
}

// Nodes: vertices first, then kPointsAnEdge a edge.
Vec3 SkinTape::place(std::uint32_t node) const {
  const auto vertices = static_cast<std::uint32_t>(position_m_.size());
  if (node < vertices) return position_m_[node];
  const auto& edge = edges_[(node - vertices) / kPointsAnEdge];
  const float t = static_cast<float>((node - vertices) % kPointsAnEdge + 1) /
                  static_cast<float>(kPointsAnEdge + 1);
  return glm::mix(position_m_[edge[0]], position_m_[edge[1]], t);
}

float SkinTape::distance_m(std::uint32_t from, std::uint32_t to) const {
  const auto vertices = static_cast<std::uint32_t>(position_m_.size());
  const std::size_t nodes = vertices + edges_.size() * kPointsAnEdge;
  std::vector<float> distance(nodes, std::numeric_limits<float>::infinity());
  using Item = std::pair<float, std::uint32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  distance[from] = 0;
  open.emplace(0.0f, from);
  while (!open.empty()) {
    const auto [d, node] = open.top();
    open.pop();
    if (d > distance[node]) continue;
    if (node == to) break;
    const Vec3 here = place(node);
    const auto visit = [&](std::uint32_t other) {
      const float further = d + glm::length(place(other) - here);
      if (further >= distance[other]) return;
      distance[other] = further;
      open.emplace(further, other);
    };
    const auto cross = [&](std::uint32_t t) {  // Straight over one triangle.
      for (const std::uint32_t v : triangles_[t]) visit(v);
      for (const std::uint32_t e : edges_of_[t])
        for (std::uint32_t k = 0; k < kPointsAnEdge; ++k) visit(vertices + e * kPointsAnEdge + k);
    };
    if (node < vertices) {
      for (const std::uint32_t t : triangles_at_[node]) cross(t);
    } else {
      for (const std::uint32_t t : triangles_of_edge_[(node - vertices) / kPointsAnEdge])
        if (t != kNone) cross(t);
    }
  }
  return distance[to];
}

std::uint32_t SkinTape::nearest_vertex(Vec3 place_m) const {
  std::uint32_t best = 0;
  float least = std::numeric_limits<float>::max();
  for (const auto& t : triangles_)
    for (const std::uint32_t v : t)
      if (const Vec3 d = position_m_[v] - place_m; glm::dot(d, d) < least)
        least = glm::dot(d, d), best = v;
  return best;
}

}  // namespace caryatid::bake::anthropometry
