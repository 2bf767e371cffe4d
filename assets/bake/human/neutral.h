#pragma once
// The MPEG-4 neutral face (ISO/IEC 14496-2 annex C; thesis 7.1): lids tangent to the iris, lips
// touching on a horizontal line at the height of the corners, mouth closed. The base human's rest
// has parted lips and half-covered irises, so the morphed head is settled before anything is fitted
// to it.
#include "assets/bake/human/feature_points.h"

namespace caryatid::bake {

// Diameter of the iris over that of the eyeball, measured on the package's eye (its ball is larger
// than life, 30 mm; so measured, the iris has 12.3 mm where people have 10.2 to 13.0).
inline constexpr float kIrisToBall = 0.413f;

// Moves lids by the base's own opening and closing shapes, lips by a field that fades over the skin
// around them. iris_diameter_m: what the lids shall just clear.
void settle_neutral(const BaseHuman& base, const std::vector<FeaturePointPlace>& places,
                    float iris_diameter_m, std::vector<Vec3>& inout_base_m);

// Measures the rules on a finished character. Throws std::runtime_error (one line) naming the rule
// that is broken and by how much.
void check_neutral(const Character& character, float iris_diameter_m);
// The part of it that concerns eyes and tongue: gaze along +Z, pupil a third of the iris, tongue
// flat with its tip where the teeth meet.
void check_inner_face(const Character& character);

}  // namespace caryatid::bake
