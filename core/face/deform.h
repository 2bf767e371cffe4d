#pragma once
// Gives the live vertices of one object the expression of one frame: rest position (geomorph
// included) + sum of the FAT's moves, weighted by the channels. Runs after the level of detail and
// before skinning.
#include <span>

#include "core/base/status.h"
#include "core/face/move_sum.h"
#include "core/mesh/progressive.h"
#include "core/pack/pack.h"

namespace caryatid::face {

// The FAT of one object, borrowed from the pack: version v owns moves [first[v], first[v + 1]).
struct ObjectFat {
  std::span<const std::uint32_t> first;  // Versions of the object + 1.
  std::span<const pack::Move> moves;     // The whole section; `first` counts from its start.
};

// Reads the pack's moves as validated (core/pack): indices are trusted.
// Cost: O(live vertices + their moves); moves of resting channels cost one load.
// Threads: different meshes may be deformed at once.
struct DeformJob {
  ObjectFat fat;
  std::span<const float> channel_weight;  // evaluate_channels()
  mesh::LiveMesh* mesh = nullptr;         // Required.
  mesh::DirtyRange* dirty = nullptr;      // Optional: slots whose bits changed are added.
  SumMoves sum = sum_moves;               // Same bits by any.

  // invalid_argument: no mesh. out_of_capacity: `fat.first` does not cover the mesh's versions;
  // then nothing is written.
  Status run() const;
};

// Sum of the moves of one vertex version. Public for tests and tools.
struct Displacement {
  Vec3 position_m{0};
  Vec3 normal{0};
};
Displacement displacement_of(const ObjectFat& fat, std::span<const float> channel_weight,
                             std::uint32_t version, SumMoves sum = sum_moves);

}  // namespace caryatid::face
