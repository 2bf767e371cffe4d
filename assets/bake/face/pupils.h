#pragma once
// Pupils (sphincter pupillae narrows, dilator pupillae widens): FAPs 29 and 30 move the vertices of
// the iris along its rays, so that the drawn pupil grows and the iris' rim stays.
#include <vector>

#include "assets/bake/face/movement.h"

namespace caryatid::bake::fat {

// Empty when the character has no eyes. Throws std::runtime_error when no pupil can be seen on
// them.
std::vector<PartMove> pupil_moves(const Character& character, const Head& head,
                                  const ReachOf& reach);

}  // namespace caryatid::bake::fat
