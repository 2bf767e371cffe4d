#pragma once
// The head's own skin texture. The base's skins give a face about 90 x 90 of their 512 x 512
// pixels; here it gets an atlas of 1024 x 1024 in which the face has most of the room: colour from
// the skin, lips, lid rims, nostrils, stubble and make-up drawn crisp from the geometry, pores and
// fine colour variation synthesised. All of it fades out towards the neck, where the body's skin
// goes on.
#include "assets/bake/human/recipe.h"
#include "assets/bake/model.h"
#include "assets/bake/texture/image.h"

namespace caryatid::bake {

// Lays the head out anew (mesh.uv changes, vertices stay as they are) and paints its image. Needs
// the feature points. `skin`: the texture that the old uv name. 1-2 s.
Image paint_head(const Character& character, const SkinRecipe& recipe, const Image& skin,
                 Mesh& head);

}  // namespace caryatid::bake
