#pragma once
// Images as the GPU takes them.
#include <cstddef>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake {

// The full mip chain of an image, largest level first, 16 bits a texel, little-endian: RGBA4444
// when the image has alpha, else RGB565. Levels are averaged in linear light with colour weighted
// by alpha; quantisation diffuses its error (Floyd & Steinberg 1976), so that skin does not band.
std::vector<std::byte> make_texels(const Image& image, std::uint32_t* level_count);

// Bytes of `count` levels of 2 bytes a texel, from level `first` on, of a width x height texture.
std::uint32_t mip_bytes(std::uint32_t width, std::uint32_t height, std::uint32_t first,
                        std::uint32_t count);

}  // namespace caryatid::bake
