#include "assets/bake/human/wet_lips.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "assets/bake/human/mesh_tools.h"

namespace caryatid::bake {
namespace {

enum class Lip : std::uint8_t { none, upper, lower };

// The wet skin near the line of the lips, by which lip's middle it is nearer to along edges.
std::vector<Lip> lips_of(const std::vector<Quad>& skin, std::uint32_t upper, std::uint32_t lower,
                         float corner_x, const Figure& figure) {
  const auto neighbours = edge_neighbours(skin, figure.base_m.size());
  std::vector<Lip> out(figure.base_m.size(), Lip::none);
  out[upper] = Lip::upper;
  out[lower] = Lip::lower;
  const Vec3 wet = figure.base_m[upper];
  constexpr float kDepth_m = 0.016f, kFront_m = 0.001f, kHeight_m = 0.006f;
  std::deque<std::uint32_t> open = {upper, lower};
  for (; !open.empty(); open.pop_front())
    for (const std::uint32_t n : neighbours[open.front()]) {
      const Vec3 d = figure.base_m[n] - wet;
      if (out[n] != Lip::none || d.z > kFront_m || d.z < -kDepth_m || std::abs(d.y) > kHeight_m ||
          std::abs(d.x) > corner_x)
        continue;
      out[n] = out[open.front()];
      open.push_back(n);
    }
  return out;
}

// The lowest (or highest) place of a lip over x and z.
class Edge {
 public:
  Edge(const std::vector<Quad>& skin, const std::vector<Lip>& lips, Lip lip, Vec3 wet,
       const std::vector<Vec3>& place)
      : sign_(lip == Lip::upper ? -1.0f : 1.0f), wet_(wet), height_(kCells * kCells, -kNowhere) {
    constexpr int kSteps = 12;
    for (const Quad& quad : skin) {
      const auto at = [&](std::size_t i) { return place[quad.vertex[i]]; };
      if (!std::all_of(quad.vertex.begin(), quad.vertex.end(),
                       [&](std::uint32_t v) { return lips[v] == lip; }))
        continue;
      for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
          const float u = float(i) / kSteps, w = float(j) / kSteps;
          const Vec3 p = glm::mix(glm::mix(at(0), at(1), u), glm::mix(at(3), at(2), u), w);
          float& h = height_[cell(p)];
          h = std::max(h, sign_ * p.y);
        }
    }
  }
  // How far p, of the other lip, lies within this one; 0 outside.
  float overlap_m(Vec3 p) const {
    const float h = height_[cell(p)];
    return h == -kNowhere ? 0.0f : std::max(h - sign_ * p.y, 0.0f);
  }

 private:
  static constexpr int kCells = 160;
  static constexpr float kCell_m = 0.0005f, kNowhere = 1e9f;
  std::size_t cell(Vec3 p) const {
    const auto index = [](float d, int from) {
      return static_cast<std::size_t>(
          std::clamp(static_cast<int>(d / kCell_m) + from, 0, kCells - 1));
    };
    return index(p.x - wet_.x, kCells / 2) * kCells + index(wet_.z - p.z, 8);
  }
  float sign_;
  Vec3 wet_;
  std::vector<float> height_;
};

}  // namespace

void part_wet_lips(const std::vector<FeaturePointPlace>& places, Figure& figure) {
  std::vector<Quad> skin;
  for (const Quad& quad : figure.base->quads())
    if (quad.group == 0) skin.push_back(quad);
  const std::uint32_t upper = base_vertex_of(places, 2, 2), lower = base_vertex_of(places, 2, 3);
  const Vec3 wet = figure.base_m[upper];
  const float corner_x = std::abs(figure.base_m[base_vertex_of(places, 2, 4)].x - wet.x);
  const std::vector<Lip> lips = lips_of(skin, upper, lower, corner_x, figure);
  constexpr int kRounds = 8;  // A vertex moves its neighbours' quads, too.
  for (int round = 0; round < kRounds; ++round) {
    const Edge above(skin, lips, Lip::upper, wet, figure.base_m),
        beneath(skin, lips, Lip::lower, wet, figure.base_m);
    for (std::uint32_t v = 0; v < lips.size(); ++v) {
      Vec3& p = figure.base_m[v];
      constexpr float kLine_m = 0.0003f;
      if (lips[v] == Lip::none || (p.z > wet.z - kLine_m && std::abs(p.x - wet.x) < kLine_m))
        continue;
      if (lips[v] == Lip::upper)
        p.y += 0.5f * beneath.overlap_m(p);
      else
        p.y -= 0.5f * above.overlap_m(p);
    }
  }
}

}  // namespace caryatid::bake
