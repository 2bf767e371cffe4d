#include "assets/bake/face/pupils.h"

#include <algorithm>
#include <cmath>

#include "assets/bake/human/inner_face.h"

namespace caryatid::bake::fat {
namespace {

// Share of the pupil's growth at a distance from its middle: whole at its edge, none at the rim of
// the iris, in the middle none for want of a direction.
float share(float r_m, const IrisMeasure& iris) {
  const float pupil = 0.5f * iris.pupil_diameter_m, rim = 0.5f * iris.iris_diameter_m;
  if (r_m < pupil) return r_m / pupil;
  return std::max((rim - r_m) / (rim - pupil), 0.0f);
}

// Rise of the iris' surface from its middle to its rim, by distance.
float slope_of(const Mesh& mesh, Vec3 middle, float rim_m) {
  float z = 0, count = 0;
  for (const Vec3& p : mesh.position_m)
    if (const float r = glm::length(Vec2(p - middle));
        p.z > middle.z - rim_m && r > 0.8f * rim_m && r < rim_m)
      z += p.z - middle.z, count += 1;
  return count > 0 ? z / count / (0.9f * rim_m) : 0.0f;
}

}  // namespace

std::vector<PartMove> pupil_moves(const Character& character, const Head& head,
                                  const ReachOf& reach) {
  std::vector<PartMove> out;
  const auto is_iris = [&](const Object& object) {
    return object.role == pack::ObjectRole::eye &&
           (character.materials[object.material].flags & pack::kCornea) == 0;
  };
  if (std::none_of(character.objects.begin(), character.objects.end(), is_iris)) return out;
  for (int side = 0; side < kSides; ++side) {
    const int fap = 29 + side;
    const IrisMeasure iris = measure_iris(character, side);
    const Vec3 middle = head.eye[static_cast<std::size_t>(side)].center_m + iris.pupil_m;
    const float rim = 0.5f * iris.iris_diameter_m;
    for (const float end : {reach(fap).low, reach(fap).high}) {
      if (end == 0.0f) continue;
      const float growth_m = 0.5f * end * metres_per_unit(head, fap);  // Of the radius.
      for (std::uint32_t o = 0; o < character.objects.size(); ++o) {
        if (!is_iris(character.objects[o])) continue;
        const Mesh& mesh = character.objects[o].mesh;
        PartMove move{o, {static_cast<std::uint16_t>(fap), 0, 0.0f, end, 0.0f, 0.0f}, {}};
        const float slope = slope_of(mesh, middle, rim);
        for (std::uint32_t v = 0; v < mesh.position_m.size(); ++v) {
          const Vec3 d = mesh.position_m[v] - middle;
          const float r = glm::length(Vec2(d));
          if (r > rim || r < 1e-6f || d.z < -rim) continue;
          const float outward_m = growth_m * share(r, iris);
          move.moves.push_back({v, outward_m * Vec3(d.x / r, d.y / r, slope), Vec3(0)});
        }
        if (!move.moves.empty()) out.push_back(std::move(move));
      }
    }
  }
  return out;
}

}  // namespace caryatid::bake::fat
