#include "assets/bake/human/cover.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "assets/bake/human/mesh_tools.h"

namespace caryatid::bake {
namespace {

constexpr float kCell_m = 0.02f;
constexpr float kReachIn_m = 0.022f;   // How deep below the skin cloth may lie.
constexpr float kReachOut_m = 0.012f;  // How far above the skin cloth still counts as near.

// Triangles of cloth in a grid of cells, to be hit by short rays.
class Cloth {
 public:
  void add(const FittedPart& part) {
    for (const Quad& quad : part.proxy.quads) {
      const auto p = [&](std::size_t k) { return part.position_m[quad.vertex[k]]; };
      add({p(0), p(1), p(2)});
      add({p(0), p(2), p(3)});
    }
  }

  // Smallest signed distance along `n` from `p` at which cloth lies within the reach; +inf: none.
  float lowest(Vec3 p, Vec3 n) const {
    float out = INFINITY;
    const Vec3 from = p - kReachIn_m * n, to = p + kReachOut_m * n;
    const glm::ivec3 low = cell(glm::min(from, to)), high = cell(glm::max(from, to));
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const auto found = cells_.find(key({x, y, z}));
          if (found == cells_.end()) continue;
          for (const std::uint32_t t : found->second) out = std::min(out, hit(t, p, n));
        }
    return out;
  }

 private:
  struct Triangle {
    Vec3 a, b, c;
  };
  static glm::ivec3 cell(Vec3 p) { return glm::ivec3(glm::floor(p / kCell_m)); }
  static std::int64_t key(glm::ivec3 c) {
    return (std::int64_t{c.x} + 512) << 40 | (std::int64_t{c.y} + 512) << 20 |
           (std::int64_t{c.z} + 512);
  }
  void add(Triangle t) {
    const auto index = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
    const glm::ivec3 low = cell(glm::min(t.a, glm::min(t.b, t.c)));
    const glm::ivec3 high = cell(glm::max(t.a, glm::max(t.b, t.c)));
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) cells_[key({x, y, z})].push_back(index);
  }
  float hit(std::uint32_t index, Vec3 p, Vec3 n) const {
    const Triangle& t = triangles_[index];
    const Vec3 e1 = t.b - t.a, e2 = t.c - t.a, h = glm::cross(n, e2);
    const float det = glm::dot(e1, h);
    if (std::abs(det) < 1e-12f) return INFINITY;
    const Vec3 s = p - t.a;
    const float u = glm::dot(s, h) / det;
    const Vec3 q = glm::cross(s, e1);
    const float v = glm::dot(n, q) / det;
    const float slack = -0.02f;
    if (u < slack || v < slack || u + v > 1 - slack) return INFINITY;
    const float distance = glm::dot(e2, q) / det;
    return distance < -kReachIn_m || distance > kReachOut_m ? INFINITY : distance;
  }

  std::vector<Triangle> triangles_;
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

std::vector<bool> cover_skin(Figure& figure, float gap_m) {
  std::vector<bool> hidden(BaseHuman::kVertexCount, false);
  std::vector<bool> near(BaseHuman::kVertexCount, false);
  Cloth cloth;
  for (const FittedPart& part : figure.parts) {
    if (!part.proxy.name.starts_with("clothes/")) continue;
    cloth.add(part);
    for (std::size_t i = 0; i < hidden.size(); ++i)
      if (part.proxy.hides[i]) hidden[i] = true;
  }
  // What is hidden and four rings around it may need a push.
  std::vector<Quad> skin;
  for (const Quad& quad : figure.base->quads())
    if (quad.group == 0) skin.push_back(quad);
  const auto neighbours = edge_neighbours(skin, hidden.size());
  near = hidden;
  for (int ring = 0; ring < 4; ++ring) {
    const std::vector<bool> before = near;
    for (std::size_t i = 0; i < near.size(); ++i)
      for (const std::uint32_t j : neighbours[i])
        if (before[j]) near[i] = true;
  }
  const auto normals = smooth_normals(skin, figure.base_m);
  std::vector<float> push(hidden.size(), 0.0f);
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    if (!near[i]) continue;
    const float distance = cloth.lowest(figure.base_m[i], normals[i]);
    if (distance < gap_m) push[i] = gap_m - distance;
  }
  // A push that ends from one vertex to the next would dent the skin in front of the cloth.
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<float> before = push;
    for (std::size_t i = 0; i < push.size(); ++i)
      for (const std::uint32_t j : neighbours[i]) push[i] = std::max(push[i], 0.5f * before[j]);
  }
  for (std::size_t i = 0; i < push.size(); ++i) figure.base_m[i] -= push[i] * normals[i];
  return hidden;
}

}  // namespace caryatid::bake
