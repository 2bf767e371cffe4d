#pragma once
// How parts that lie on the skin follow it: brows with the skin beneath them, lashes by the turn of
// the lid's rim beside them.
#include <array>
#include <vector>

#include "assets/bake/face/head.h"

namespace caryatid::bake::fat {

// For each vertex of a part: the skin vertices that carry it, with weights that sum to 1.
struct Carrier {
  std::array<std::uint32_t, 4> skin{};
  std::array<float, 4> weight{};
  int eye = -1;  // >= 0: hinged on this eye's lid.
};
using Carriers = std::vector<Carrier>;

Carriers carriers_of_brow(const Head& head, const Mesh& mesh);
Carriers carriers_of_lash(const Head& head, const Mesh& mesh);

// Displacement of a part's vertex for a displaced skin.
Vec3 followed(const Head& head, const Carrier& carrier, Vec3 position_m,
              const std::vector<Vec3>& displacement);

}  // namespace caryatid::bake::fat
