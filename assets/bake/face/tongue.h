#pragma once
// Tongue (genioglossus thrusts, styloglossus raises, the intrinsic muscles curl): FAPs 43-47 move
// the tongue's own object, at rest in the closed mouth; the jaw's joint carries all of it.
#include <vector>

#include "assets/bake/face/movement.h"

namespace caryatid::bake::fat {

// Empty when the character has no tongue (an object named "tongue" in which point 6.1 lies).
std::vector<PartMove> tongue_moves(const Character& character, const Head& head,
                                   const ReachOf& reach);

}  // namespace caryatid::bake::fat
