#pragma once
// Seats teeth and tongue behind the lips as people have them. The package's dentition lies 12 mm
// behind the lips with its edges above their line and leans back: open mouths looked toothless.
#include "assets/bake/human/figure.h"

namespace caryatid::bake {

// How far the edges of the upper incisors hang below the line of the closed lips: what parted lips
// at rest show of them. Vig and Brundo 1978 measured 3.4 mm in women and 1.9 mm in men; ours lie
// within that span, a little nearer to each other, as their adults under 40 do.
inline constexpr float kIncisorShowWoman_m = 0.0030f, kIncisorShowMan_m = 0.0024f;

// Vertices of a part that hang on the jaw or on bones beneath it, by the part's own weights.
std::vector<bool> on_jaw(const BaseHuman& base, const Proxy& proxy);

// Moves teeth and tongue of a figure with a neutral face down and forward, the front teeth most, so
// that the arch rounds; levels the plane of the bite, sets the upper incisors upright and their
// crowns to a person's height; then the lining of lips and cheeks gives way.
// show_m: as above. Figures without teeth stay as they are.
void seat_bite(const std::vector<FeaturePointPlace>& places, float show_m, Figure& inout_figure);

}  // namespace caryatid::bake
