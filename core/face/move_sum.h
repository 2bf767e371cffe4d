#pragma once
// Inner loop of the deformation: the weighted sum of one vertex version's moves. One version for
// any CPU and one for NEON, which ARMv8 always has and ARMv7 may lack: who knows the CPU chooses
// (platform/cpu.h). Both do the same sums and products in the same order, none of them fused, so
// their bits are the same. Cost: O(moves); those of resting channels cost one load.
#include <span>

#include "core/pack/pack.h"

namespace caryatid::face {

// Weights below count as rest: ARMv7's NEON takes denormal numbers for zero, and no product of
// these shall become one.
inline constexpr float kLeastWeight = 1e-20f;

// In steps of the pack: kMoveStep_m and 1/127.
struct MoveSum {
  float d[3] = {};
  float normal[3] = {};
};

// `moves` of channels beyond `channel_weight` are passed over.
using SumMoves = MoveSum (*)(std::span<const pack::Move> moves,
                             std::span<const float> channel_weight);
MoveSum sum_moves(std::span<const pack::Move> moves, std::span<const float> channel_weight);
#if defined(__arm__) || defined(__aarch64__)
// Needs a CPU with NEON.
MoveSum sum_moves_neon(std::span<const pack::Move> moves, std::span<const float> channel_weight);
#endif

// The one to use on a CPU that has NEON or not; elsewhere than on ARM there is no choice.
constexpr SumMoves sum_moves_for([[maybe_unused]] bool neon) {
#if defined(__arm__) || defined(__aarch64__)
  if (neon) return sum_moves_neon;
#endif
  return sum_moves;
}

}  // namespace caryatid::face
