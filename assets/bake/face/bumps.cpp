// Parts that move as a soft patch around one point: cheeks (zygomaticus minor lifts, buccinator
// holds the puffed cheek), nose (nasalis spreads the wings, levator labii alaeque nasi raises),
// chin (mentalis), ears (auriculares).
#include <algorithm>
#include <cmath>

#include "assets/bake/face/movement.h"

namespace caryatid::bake::fat {
namespace {

using Weights = std::vector<float>;

std::vector<Vec3> along(const Weights& weight, Vec3 direction, float m) {
  std::vector<Vec3> field;
  for (const float w : weight) field.push_back(w * m * direction);
  return field;
}

// Fades a patch out towards `edge`.
void fade(const Head& head, const std::vector<std::uint32_t>& edge, float over_m, Weights& weight) {
  const auto away = distance_m(head.skin, edge, over_m);
  for (std::uint32_t v = 0; v < weight.size(); ++v)
    if (away[v] < over_m) {
      const float t = away[v] / over_m;
      weight[v] *= t * t * (3.0f - 2.0f * t);
    }
}

// Keeps a patch off lips and lids, whose vertices belong to other FAPs. The loose skin beneath the
// lids takes more room, or a raised cheek would fold it.
void spare_lips_and_eyes(const Head& head, Weights& weight) {
  std::vector<std::uint32_t> lips, rims;
  for (const Lips& half : head.lips)
    for (std::size_t r = half.upper_outer; r < half.row.size(); ++r)
      lips.insert(lips.end(), half.row[r].begin(), half.row[r].end());
  for (const Eye& eye : head.eye) {
    rims.insert(rims.end(), eye.rim.begin(), eye.rim.end());
    for (std::uint32_t v = 0; v < weight.size(); ++v)
      if (eye.inside[v]) weight[v] = 0.0f;
  }
  fade(head, lips, 0.008f, weight);
  fade(head, rims, 0.014f, weight);
}

Weights patch(const Head& head, int group, int index, float radius_m) {
  if (!head.point_vertex.contains({group, index})) return Weights(head.skin.size(), 0.0f);
  const std::uint32_t at = head.vertex_of(group, index);
  Weights weight = bump(head, at, radius_m);
  spare_lips_and_eyes(head, weight);
  // On a coarse head the point may lie where lips fade out; it moves by the whole amount all the
  // same.
  constexpr float kLeast = 0.3f;
  const float top = std::max(weight[at], kLeast);
  for (float& w : weight) w /= top;
  weight[at] = 1.0f;
  return weight;
}

}  // namespace

void add_bumps(const Head& head, const ReachOf& reach, std::vector<Movement>& out) {
  const auto add = [&](int fap, const Weights& weight, Vec3 direction) {
    add_movements(
        head, fap, reach(fap), 1, [&](float m) { return along(weight, direction, m); }, out);
  };
  for (int side = 0; side < kSides; ++side) {
    const float x = outward(side);
    // Outwards is along X by the standard; a full cheek also comes forward.
    add(39 + side, patch(head, 5, 1 + side, 0.034f), {x, 0, 0.45f});
    // The cheek slides up over the bone and bulges.
    add(41 + side, patch(head, 5, 3 + side, 0.032f), {0.12f * x, 1, 0.35f});
    add(61 + side, patch(head, 9, 1 + side, 0.012f), {x, 0.1f, 0});
    add(65 + side, patch(head, 10, 1 + side, 0.055f), {0, 1, 0});
    add(67 + side, patch(head, 10, 3 + side, 0.055f), {x, 0, 0});
  }
  const Weights tip = patch(head, 9, 3, 0.024f);
  add(63, tip, {0, 1, 0.1f});
  add(64, tip, {-1, 0, 0});
  add(18, patch(head, 2, 10, 0.022f), {0, 1, 0.2f});
}

}  // namespace caryatid::bake::fat
