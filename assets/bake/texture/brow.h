#pragma once
// Brows that begin as single hairs instead of a drawn edge.
#include <span>

#include "assets/bake/human/makehuman.h"
#include "assets/bake/texture/image.h"

namespace caryatid::bake {

// Thins the image's alpha where the fitted brows come nearest to the middle of the face: over
// several millimetres hairs grow sparse and fine. position_m: of the proxy's vertices.
void thin_heads(const Proxy& brows, std::span<const Vec3> position_m, LinearImage& image);

}  // namespace caryatid::bake
