#include "assets/bake/face/movement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/face/fap_table.h"

namespace caryatid::bake::fat {

using face::FapUnit;

float metres_per_unit(const Head& head, int fap) {
  const pack::Character& f = head.facts;
  switch (face::fap_info(fap).unit) {
    case FapUnit::mns:
      return f.mouth_nose_m / 1024.0f;
    case FapUnit::mw:
      return f.mouth_width_m / 1024.0f;
    case FapUnit::ens:
      return f.eye_nose_m / 1024.0f;
    case FapUnit::es:
      return f.eye_separation_m / 1024.0f;
    case FapUnit::irisd:
      return f.iris_diameter_m / 1024.0f;
    case FapUnit::au:
    case FapUnit::none:
      break;
  }
  return 1e-5f;  // AU: "metres" are radians then.
}

void add_movements(const Head& head, int fap, Range reach, int steps, const Field& displace,
                   std::vector<Movement>& out) {
  const float unit_m = metres_per_unit(head, fap);
  for (const float end : {reach.low, reach.high}) {
    if (end == 0.0f) continue;
    Movement movement{.fap = fap, .reach = end, .frames = {}};
    for (int k = 1; k <= steps; ++k)
      movement.frames.push_back(
          displace(end * unit_m * static_cast<float>(k) / static_cast<float>(steps)));
    out.push_back(std::move(movement));
  }
}

std::vector<float> bump(const Head& head, std::uint32_t at, float radius_m) {
  const std::uint32_t source[] = {at};
  const std::vector<float> walk = distance_m(head.skin, source, 1.6f * radius_m);
  std::vector<float> weight(head.skin.size(), 0.0f);
  for (std::uint32_t v = 0; v < weight.size(); ++v) {
    if (!std::isfinite(walk[v])) continue;
    // Mostly the straight distance (edges zigzag), but never ahead of the way along the skin.
    const float straight = glm::length(head.skin.position_m[v] - head.skin.position_m[at]);
    const float t = std::max(straight, 0.75f * walk[v]) / radius_m;
    if (t < 1.0f) weight[v] = (1.0f - t * t) * (1.0f - t * t);
  }
  return weight;
}

Vec3 along_surface(Vec3 normal, Vec3 direction) {
  const Vec3 tangent = direction - normal * glm::dot(normal, direction);
  const float part = glm::dot(tangent, direction);
  constexpr float kSteepest = 1.0f / (1.5f * 1.5f);
  if (part < kSteepest) return direction + (tangent - direction * part) * 0.5f;
  return tangent / part;
}

}  // namespace caryatid::bake::fat
