#pragma once
// From a recipe to a character: what the rest of the bake starts from.
#include "assets/bake/human/feature_points.h"
#include "assets/bake/human/makehuman.h"
#include "assets/bake/human/recipe.h"
#include "assets/bake/model.h"

namespace caryatid::bake {

// Meshes, skeleton, feature points, textures, FAPU and licences of the person; FAT channels and
// occlusion are left to later stages. The objects:
//   head               skin above a loop at the foot of the neck; closed inside by mouth and
//   sockets body, legs         what clothes leave of the rest; shared borders with `head` are
//   bit-equal l_hand, r_hand     and locked l_eye, r_eye, upper_teeth, lower_teeth, tongue, brows,
//   lashes, hair, and one object a garment
// Joints: all of body::HanimJoint, in its order. Takes a few seconds.
// Throws std::runtime_error (one line) when the recipe is wrong, breaks a rule of the MPEG-4
// neutral face, or uses an asset whose licence does not allow it.
Character build_character(const Recipe& recipe, const BaseHuman& base,
                          const std::vector<FeaturePointPlace>& places);

}  // namespace caryatid::bake
