#include "assets/bake/face/skin.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>

namespace caryatid::bake::fat {
namespace {

void add_unique(std::vector<std::uint32_t>& list, std::uint32_t value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

// The edge opposite to (previous, at) at a vertex of four edges; kNone elsewhere.
std::uint32_t straight_on(const Skin& skin, std::uint32_t previous, std::uint32_t at) {
  if (skin.neighbours[at].size() != 4) return kNone;
  for (const std::uint32_t next : skin.neighbours[at]) {
    bool shares_quad = next == previous;
    for (const std::uint32_t q : skin.quads_at[at]) {
      const auto& quad = skin.quads[q];
      const auto has = [&](std::uint32_t v) {
        return std::find(quad.begin(), quad.end(), v) != quad.end();
      };
      shares_quad |= has(previous) && has(next);
    }
    if (!shares_quad) return next;
  }
  return kNone;
}

}  // namespace

Skin make_skin(std::span<const Vec3> position_m,
               std::span<const std::array<std::uint32_t, 4>> quads) {
  Skin skin;
  skin.of_base.assign(position_m.size(), kNone);
  for (const auto& quad : quads)
    for (const std::uint32_t v : quad) skin.of_base[v] = 0;
  for (std::uint32_t v = 0; v < position_m.size(); ++v) {
    if (skin.of_base[v] == kNone) continue;
    skin.of_base[v] = skin.size();
    skin.base.push_back(v);
    skin.position_m.push_back(position_m[v]);
  }
  skin.neighbours.resize(skin.size());
  skin.quads_at.resize(skin.size());
  for (const auto& source : quads) {
    std::array<std::uint32_t, 4> quad{};
    for (std::size_t i = 0; i < 4; ++i) quad[i] = skin.of_base[source[i]];
    for (std::size_t i = 0; i < 4; ++i) {
      add_unique(skin.neighbours[quad[i]], quad[(i + 1) % 4]);
      add_unique(skin.neighbours[quad[(i + 1) % 4]], quad[i]);
      skin.quads_at[quad[i]].push_back(static_cast<std::uint32_t>(skin.quads.size()));
    }
    skin.quads.push_back(quad);
    skin.triangles.push_back({quad[0], quad[1], quad[2]});
    skin.triangles.push_back({quad[0], quad[2], quad[3]});
  }
  for (auto& list : skin.neighbours) std::sort(list.begin(), list.end());
  return skin;
}

Skin make_triangle_skin(std::span<const Vec3> position_m,
                        std::span<const std::array<std::uint32_t, 3>> triangles) {
  Skin skin;
  skin.position_m.assign(position_m.begin(), position_m.end());
  skin.triangles.assign(triangles.begin(), triangles.end());
  skin.base.resize(skin.size());
  std::iota(skin.base.begin(), skin.base.end(), 0u);
  skin.of_base = skin.base;
  skin.quads_at.resize(skin.size());
  skin.neighbours.resize(skin.size());
  for (const auto& t : skin.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      add_unique(skin.neighbours[t[i]], t[(i + 1) % 3]);
      add_unique(skin.neighbours[t[(i + 1) % 3]], t[i]);
    }
  for (auto& list : skin.neighbours) std::sort(list.begin(), list.end());
  return skin;
}

std::vector<std::uint32_t> ring(const Skin& skin, std::uint32_t from, std::uint32_t toward,
                                std::size_t at_most) {
  std::vector<std::uint32_t> out = {from, toward};
  while (out.size() < at_most) {
    const std::uint32_t next = straight_on(skin, out[out.size() - 2], out.back());
    if (next == kNone || next == from) break;
    out.push_back(next);
  }
  return out;
}

std::vector<float> distance_m(const Skin& skin, std::span<const std::uint32_t> sources,
                              float limit_m) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  std::vector<float> distance(skin.size(), kFar);
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const std::uint32_t v : sources) {
    distance[v] = 0.0f;
    open.emplace(0.0f, v);
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    for (const std::uint32_t n : skin.neighbours[v]) {
      const float further = d + glm::length(skin.position_m[n] - skin.position_m[v]);
      if (further >= distance[n] || further > limit_m) continue;
      distance[n] = further;
      open.emplace(further, n);
    }
  }
  return distance;
}

std::vector<Vec3> normals(const Skin& skin, std::span<const Vec3> position_m) {
  std::vector<Vec3> out(skin.size(), Vec3(0));
  for (const auto& t : skin.triangles) {
    const Vec3 n =
        glm::cross(position_m[t[1]] - position_m[t[0]], position_m[t[2]] - position_m[t[0]]);
    for (const std::uint32_t v : t) out[v] += n;
  }
  for (Vec3& n : out) {
    const float length = glm::length(n);
    n = length > 0.0f ? n / length : Vec3(0, 0, 1);
  }
  return out;
}

}  // namespace caryatid::bake::fat
