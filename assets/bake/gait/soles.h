#pragma once
#include "assets/bake/model.h"

namespace caryatid::bake {

// Finds the soles of the finished figure in its vertices (body::SoleFitter) and adds them as
// feature points of the private group pack::kSoleGroup, for the walk on the board.
void add_sole_points(Character& character);

}  // namespace caryatid::bake
