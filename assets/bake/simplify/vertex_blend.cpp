#include "assets/bake/simplify/vertex_blend.h"

#include <algorithm>
#include <map>

namespace caryatid::bake {
namespace {

// A quarter of the smallest movement that shows: a pixel of a close-up is about 0.3 mm.
constexpr float kLeastMove_m = 5e-6f;

Influence blend_influences(const std::array<const VertexVersion*, 3>& from,
                           const std::array<double, 3>& weight) {
  std::map<std::uint16_t, float> sum;
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t j = 0; j < 4; ++j)
      sum[from[i]->influence.joint[j]] +=
          static_cast<float>(weight[i]) * from[i]->influence.weight[j];
  std::vector<std::pair<float, std::uint16_t>> order;
  for (const auto& [joint, w] : sum)
    if (w > 0.0f) order.push_back({w, joint});
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  order.resize(std::min<std::size_t>(order.size(), 4));
  float total = 0.0f;
  for (const auto& [w, joint] : order) total += w;
  Influence out;
  out.weight = {};
  for (std::size_t j = 0; j < order.size(); ++j) {
    out.joint[j] = order[j].second;
    out.weight[j] = order[j].first / total;
  }
  return out;
}

VertexVersion blend(const std::array<const VertexVersion*, 3>& from,
                    const std::array<double, 3>& weight) {
  VertexVersion out;
  std::map<std::uint16_t, VertexVersion::ChannelMove> moves;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto w = static_cast<float>(weight[i]);
    out.position_m += w * from[i]->position_m;
    out.normal += w * from[i]->normal;
    out.uv += w * from[i]->uv;
    out.occlusion += w * from[i]->occlusion;
    for (const VertexVersion::ChannelMove& m : from[i]->moves) {
      VertexVersion::ChannelMove& sum = moves[m.channel];
      sum.channel = m.channel;
      sum.displacement_m += w * m.displacement_m;
      sum.normal_change += w * m.normal_change;
    }
  }
  const float length = glm::length(out.normal);
  out.normal = length > 1e-6f ? out.normal / length : from[0]->normal;
  out.influence = blend_influences(from, weight);
  for (const auto& [channel, m] : moves)
    if (glm::length(m.displacement_m) >= kLeastMove_m) out.moves.push_back(m);
  return out;
}

}  // namespace

std::array<double, 3> closest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b,
                                          const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

void SurfacePoint::consider(const Vec3d& x, const std::array<Vec3d, 3>& corner,
                            const std::array<std::uint32_t, 3>& corner_version) {
  const std::array<double, 3> w = closest_on_triangle(x, corner[0], corner[1], corner[2]);
  const double d2 = length2(x - (w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2]));
  if (!(d2 < distance2)) return;
  distance2 = d2;
  version = corner_version;
  weight = w;
}

VertexVersion blend_triangle(const std::vector<VertexVersion>& versions, const SurfacePoint& at) {
  return blend({&versions[at.version[0]], &versions[at.version[1]], &versions[at.version[2]]},
               at.weight);
}

VertexVersion blend_edge(const VertexVersion& a, const VertexVersion& b, double s) {
  return blend({&a, &b, &b}, {1 - s, s, 0});
}

}  // namespace caryatid::bake
