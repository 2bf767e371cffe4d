#pragma once
// Moving pictures that every browser shows without a player: PNG with the animation chunks of the
// PNG specification's third edition (acTL, fcTL, fdAT), 255 colours for all frames.
#include <string>
#include <vector>

#include "assets/tool/picture.h"

namespace caryatid::tool {

// Frames of one size, shown for frame_ms each, again and again. Pixels that stay as they were cost
// next to nothing. Throws std::runtime_error, one line, when the file can't be written.
void write_animated_png(const std::vector<Picture>& frames, unsigned frame_ms,
                        const std::string& path);

}  // namespace caryatid::tool
