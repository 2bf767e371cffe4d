#pragma once
// Skin beneath clothes: what a garment hides goes, what lies at its border is pushed inwards, so
// that no skin shows through a skirt or a collar.
#include <vector>

#include "assets/bake/human/figure.h"

namespace caryatid::bake {

// By base vertex: true where a garment or shoe hides the skin. Pushes skin under and near garments
// to at least `gap_m` beneath the cloth (figure.base_m changes).
std::vector<bool> cover_skin(Figure& figure, float gap_m);

}  // namespace caryatid::bake
