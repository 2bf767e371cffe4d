#pragma once
// Opens or narrows the lids of the base human by the same turn about the eyeball that the FAT uses,
// so that a neutral face has the lids that MPEG-4 asks for: tangent to the iris. Morph targets are
// straight lines and tear a wide lid off the ball.
#include <map>
#include <utility>
#include <vector>

#include "assets/bake/human/makehuman.h"

namespace caryatid::bake::fat {

// Base vertices of feature points 3.1-3.4 (lid middles) and 4.1-4.6 (brows).
using LidPoints = std::map<std::pair<int, int>, std::uint32_t>;

// Moves both lids (0.7 upper, 0.3 lower) of both eyes until 3.1 - 3.3 and 3.2 - 3.4 are `opening_m`
// apart; lash helpers go along. `base_m` are positions of the base human, BaseHuman::kVertexCount
// long, in its own rest pose.
void open_lids(const BaseHuman& base, const LidPoints& points, float opening_m,
               std::vector<Vec3>& base_m);

}  // namespace caryatid::bake::fat
