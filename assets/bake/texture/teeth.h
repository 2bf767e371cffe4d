#pragma once
// The teeth's texture: ivory and pink where the base draws grey and dark red.
#include "assets/bake/texture/image.h"

namespace caryatid::bake {

// Tells tooth from gum by saturation. Keeps what the base drew of form, in less contrast: light and
// shade come from the renderer.
void paint_teeth(LinearImage& image);

}  // namespace caryatid::bake
