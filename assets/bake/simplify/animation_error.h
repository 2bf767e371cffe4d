#pragma once
// What simplification does to the animation: how far feature points of a coarser level lie from
// where the full object has them, FAP by FAP. Locked points keep vertex, place and FAT: 0.
#include <cstdint>
#include <vector>

#include "assets/bake/model.h"
#include "assets/bake/simplify/object_history.h"

namespace caryatid::bake {

struct AnimationError {
  int fap = 0;
  float worst_fapu = 0;           // Distance in the FAP's own FAPU (1/1024 of the face's measure).
  float moved_fapu = 0;           // How far that FAP moves a feature point of the object at most.
  std::uint32_t lost_points = 0;  // Feature points whose vertex is not live at this level.
};

// Every FAP of the object's FAT but rotations, each at its full ramp (both ways; the worse counts),
// at the finest level of at most `triangles`. `history` is that of character.objects[object].
// O(splits + channels * points * log).
std::vector<AnimationError> animation_error(const Character& character, std::uint32_t object,
                                            const ObjectHistory& history, std::uint32_t triangles);

}  // namespace caryatid::bake
