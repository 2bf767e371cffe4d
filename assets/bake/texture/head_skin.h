#pragma once
// The head's own skin texture. The base's skins give a face about 90 x 90 of their 512 x 512
// pixels; here it gets an atlas of 1024 x 1024 in which the face has most of the room: colour from
// the skin, lips, lid rims, nostrils, stubble and make-up drawn crisp from the geometry, pores and
// fine colour variation synthesised, the hairline grown from the style. All but the last fades out
// towards the border at the neck, where the body's skin goes on.
#include "assets/bake/human/recipe.h"
#include "assets/bake/model.h"
#include "assets/bake/texture/image.h"

namespace caryatid::bake {

struct HeadImages {
  Image skin;
  Image lines;  // Detail: see wrinkles.h. Half as large; the same layout.
};

// Lays the head out anew (mesh.uv changes, vertices stay as they are) and paints its images. Needs
// the feature points, and the hair in place. `skin`: the texture that the old uv name. border_m:
// the vertices that the head shares with other skin. 2-3 s.
HeadImages paint_head(const Character& character, const SkinRecipe& recipe, const Image& skin,
                      const std::vector<Vec3>& border_m, Mesh& head);

}  // namespace caryatid::bake
