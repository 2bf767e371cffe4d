#pragma once
// A character cut down to what fits into the agent's program: the built-in face that shows when a
// pack is missing or damaged.
#include "assets/bake/model.h"

namespace caryatid::bake {

// Keeps head, eyes, brows, hair and the garment at the neck; textures of at most `texture_side`
// texels; drops movements that would not be seen on a coarse head. Feature points of dropped
// objects go with them.
Character small_character(const Character& full, std::uint32_t texture_side);

}  // namespace caryatid::bake
