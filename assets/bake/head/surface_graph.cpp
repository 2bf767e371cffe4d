#include "assets/bake/head/surface_graph.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <queue>

namespace caryatid::bake::foreign {

SurfaceGraph::SurfaceGraph(std::span<const Vec3> position_m, const Triangles& triangles)
    : position_m_(position_m) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Vec3>> normals;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 n = glm::cross(position_m[b] - position_m[a], position_m[c] - position_m[a]);
    const float length = glm::length(n);
    for (const auto& edge : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)})
      normals[edge].push_back(length > 0 ? n / length : Vec3(0));
  }
  neighbours_.resize(position_m.size());
  ease_.resize(position_m.size());
  constexpr float kSharp = 0.45f;
  for (const auto& [edge, sides] : normals) {
    const float fold = sides.size() == 2 ? 1.0f - glm::dot(sides[0], sides[1]) : 1.0f;
    const float ease = glm::mix(1.0f, kSharp, std::clamp(1.5f * fold, 0.0f, 1.0f));
    neighbours_[edge.first].push_back(edge.second);
    neighbours_[edge.second].push_back(edge.first);
    ease_[edge.first].push_back(ease);
    ease_[edge.second].push_back(ease);
  }
}

std::vector<std::uint32_t> SurfaceGraph::way(std::uint32_t from, std::uint32_t to,
                                             const std::vector<bool>& barred) const {
  constexpr float kAside = 3.0f;
  const Vec3 a = position_m_[from], span = position_m_[to] - a;
  const float length = std::max(glm::length(span), 1e-6f);
  const auto aside = [&](Vec3 p) {  // Distance from the straight line, in its length.
    const float t = std::clamp(glm::dot(p - a, span) / (length * length), 0.0f, 1.0f);
    return glm::length(p - a - t * span) / length;
  };
  std::vector<float> cost(position_m_.size(), std::numeric_limits<float>::infinity());
  std::vector<std::uint32_t> before(position_m_.size(), kNone);
  using Item = std::pair<float, std::uint32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  cost[from] = 0;
  open.emplace(0.0f, from);
  while (!open.empty()) {
    const auto [c, v] = open.top();
    open.pop();
    if (c > cost[v]) continue;
    if (v == to) break;
    for (std::size_t i = 0; i < neighbours_[v].size(); ++i) {
      const std::uint32_t n = neighbours_[v][i];
      if (n != to && !barred.empty() && barred[n]) continue;
      const Vec3 p = position_m_[v], q = position_m_[n];
      const float step = glm::length(q - p) * (1.0f + kAside * aside(0.5f * (p + q))) * ease_[v][i];
      if (c + step >= cost[n]) continue;
      cost[n] = c + step;
      before[n] = v;
      open.emplace(cost[n], n);
    }
  }
  std::vector<std::uint32_t> out;
  if (from != to && before[to] == kNone) return out;
  for (std::uint32_t v = to; v != kNone; v = before[v]) out.push_back(v);
  std::reverse(out.begin(), out.end());
  return out;
}

std::vector<bool> SurfaceGraph::reached(std::uint32_t from, const std::vector<bool>& barred) const {
  std::vector<bool> seen(position_m_.size(), false);
  std::vector<std::uint32_t> open{from};
  while (!open.empty()) {
    const std::uint32_t v = open.back();
    open.pop_back();
    if (seen[v] || barred[v]) continue;
    seen[v] = true;
    open.insert(open.end(), neighbours_[v].begin(), neighbours_[v].end());
  }
  return seen;
}

std::vector<std::uint32_t> parts_of(std::size_t vertices, const Triangles& triangles) {
  std::vector<std::uint32_t> up(vertices);
  std::iota(up.begin(), up.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (up[v] != v) v = up[v] = up[up[v]];
    return v;
  };
  for (const auto& t : triangles)
    for (std::size_t i = 1; i < 3; ++i) up[root(t[i])] = root(t[0]);
  std::vector<std::uint32_t> label(vertices, kNone);
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    std::uint32_t& of_root = label[root(v)];
    if (of_root == kNone) of_root = count++;
    label[v] = of_root;
  }
  return label;
}

namespace {

// Triangles at vertex v that lie left of the chain previous -> v -> next.
std::vector<std::size_t> left_of(std::uint32_t previous, std::uint32_t v, std::uint32_t next,
                                 const std::vector<std::size_t>& fan, const Triangles& triangles) {
  const auto has = [&](std::size_t t, std::uint32_t a, std::uint32_t b) {
    for (std::size_t i = 0; i < 3; ++i)
      if (triangles[t][i] == a && triangles[t][(i + 1) % 3] == b) return true;
    return false;
  };
  std::vector<std::size_t> left;
  for (const std::size_t t : fan)
    if (has(t, previous, v) || has(t, v, next)) left.push_back(t);
  for (std::size_t i = 0; i < left.size(); ++i)  // On to neighbours in the fan, not over the chain.
    for (const std::size_t t : fan) {
      if (std::find(left.begin(), left.end(), t) != left.end()) continue;
      for (const std::uint32_t w : triangles[left[i]])
        if (w != v && w != previous && w != next &&
            std::find(triangles[t].begin(), triangles[t].end(), w) != triangles[t].end()) {
          left.push_back(t);
          break;
        }
    }
  return left;
}

}  // namespace

std::vector<std::uint32_t> cut_along(std::span<const std::uint32_t> chain,
                                     std::vector<Vec3>& position_m, Triangles& triangles) {
  std::vector<std::uint32_t> twin(chain.begin(), chain.end());
  Triangles cut = triangles;
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    std::vector<std::size_t> fan;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (std::find(triangles[t].begin(), triangles[t].end(), chain[i]) != triangles[t].end())
        fan.push_back(t);
    twin[i] = static_cast<std::uint32_t>(position_m.size());
    position_m.push_back(position_m[chain[i]]);
    for (const std::size_t t : left_of(chain[i - 1], chain[i], chain[i + 1], fan, triangles))
      for (std::uint32_t& v : cut[t])
        if (v == chain[i]) v = twin[i];
  }
  triangles = std::move(cut);
  return twin;
}

}  // namespace caryatid::bake::foreign
