#pragma once
#include "assets/bake/model.h"

namespace caryatid::bake {

// Fills Mesh::occlusion of every object: how much of the sky above a vertex the person hides, by
// rays at rest, near things more than far ones. What moves against its neighbours is treated apart:
//  - eyes, lashes and brows stay open, since the shade of the lids must not turn with the gaze (the
//    renderer draws it);
//  - teeth and tongue darken with their depth behind the front teeth, as if the mouth were open;
//  - skin keeps some light even in the closed mouth, for when it opens.
// Deterministic. O(vertices * rays * log triangles): about 3 s for a person on a PC.
void bake_occlusion(Character& character);

}  // namespace caryatid::bake
