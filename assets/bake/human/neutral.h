#pragma once
// The MPEG-4 neutral face (ISO/IEC 14496-2 annex C; thesis 7.1): lids tangent to the iris, lips
// touching on a horizontal line at the height of the corners, mouth closed. The base human's rest
// has parted lips and half-covered irises, so the morphed head is settled before anything is fitted
// to it.
#include "assets/bake/human/feature_points.h"

namespace caryatid::bake {

// Diameter of the iris that a lid opening must show: the human ratio to the eyeball, 11.8 to 24.2
// mm.
inline constexpr float kIrisToBall = 11.8f / 24.2f;

// Moves lids by the base's own opening and closing shapes, lips by a field that fades over the skin
// around them. iris_diameter_m: what the lids shall just clear.
void settle_neutral(const BaseHuman& base, const std::vector<FeaturePointPlace>& places,
                    float iris_diameter_m, std::vector<Vec3>& inout_base_m);

// Measures the rules on a finished character. Throws std::runtime_error (one line) naming the rule
// that is broken and by how much.
void check_neutral(const Character& character, float iris_diameter_m);

}  // namespace caryatid::bake
