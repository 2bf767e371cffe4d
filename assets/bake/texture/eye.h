#pragma once
// The eyeballs' texture: an iris of a recipe's colour drawn into the base's pair of eyes, and a
// white that is not white.
#include "assets/bake/texture/image.h"

namespace caryatid::bake {

// Paints over the base's layout of two eyes in one image (HighPolyEyes). iris: mean colour, sRGB
// 0..1. Fibres from the pupil's edge to a dark limbal ring, a warmer collar round the pupil, the
// lower half lighter, as the cornea gathers light from above there. The pupil is a third of the
// iris.
void paint_eyes(Vec3 iris, LinearImage& image);

}  // namespace caryatid::bake
