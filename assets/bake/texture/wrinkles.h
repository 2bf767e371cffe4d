#pragma once
// The lines of a face, drawn where its muscles fold it: the detail texture of the head's skin.
#include "assets/bake/texture/atlas.h"

namespace caryatid::bake {

// Red: rows of the forehead. Green: upright lines between the brows, and the one across the root of
// the nose. Blue: the fan at the corners of the eyes and the bag under them. Alpha: the fold from
// nose to mouth (as face::Wrinkle). A value v shades the skin by (v - 8/15) times the weight that
// face::wrinkles_of gives: less is furrow, more is ridge; 8/15 is level and exact in 4 bits. Data,
// not colour. depth: 1 for the lines of middle age. Needs the feature points. 0.2 s.
Image draw_wrinkles(const Character& character, const SkinMap& skin, float depth);

}  // namespace caryatid::bake
