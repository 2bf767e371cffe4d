#pragma once
// The hair that grows on the skin itself. A style's mesh ends in an edge; what makes a hairline are
// the roots beneath it and the short hairs before it. Both are painted into the head's texture:
// hair colour under the style, strands across its edge that thin out over a centimetre.
#include "assets/bake/texture/atlas.h"
#include "assets/bake/texture/image.h"

namespace caryatid::bake {

// Paints over `atlas`, whose texels show `skin`. Uses the objects of role hair with their images;
// without any it does nothing. reach_m: how far the longest hairs come out under the edge.
// Deterministic; about 1 s.
void paint_hairline(const Character& character, const SkinMap& skin, float reach_m,
                    LinearImage& atlas);

}  // namespace caryatid::bake
