#pragma once
// A person on the way from the base human to bake::Character: still quads on hm08's numbering, so
// that every stage can use the base's own topology. Metres. Internal to the room; the stages are
// morph -> neutral face -> fitted parts -> rest pose -> cover -> objects.
#include <vector>

#include "assets/bake/human/feature_points.h"
#include "assets/bake/human/makehuman.h"
#include "assets/bake/human/recipe.h"

namespace caryatid::bake {

struct FittedPart {
  Proxy proxy;
  PartRecipe recipe;
  std::vector<Vec3> position_m;
};

struct Figure {
  const BaseHuman* base = nullptr;
  std::vector<Vec3> base_m;       // 19158, with the helpers.
  std::vector<Vec3> bone_head_m;  // By bone.
  std::vector<FittedPart> parts;

  // The part whose proxy's folder starts with `kind` ("eyes", "hair"), nullptr when there is none.
  const FittedPart* part(std::string_view kind) const;
  // Centre of the left (0) or right (1) eyeball.
  Vec3 eye_center_m(int side) const;
  float eye_diameter_m() const;
};

// Macro and feature targets, the neutral face, then the parts fitted to the result.
Figure make_figure(const Recipe& recipe, const BaseHuman& base,
                   const std::vector<FeaturePointPlace>& places);
// To the H-Anim rest pose, soles of shoes on the floor, origin between the feet.
void stand(Figure& figure);

}  // namespace caryatid::bake
