#include "core/face/move_sum.h"

namespace caryatid::face {

MoveSum sum_moves(std::span<const pack::Move> moves, std::span<const float> channel_weight) {
  MoveSum sum;
  for (const pack::Move& move : moves) {
    if (move.channel >= channel_weight.size()) continue;
    const float w = channel_weight[move.channel];
    if (w < kLeastWeight && w > -kLeastWeight) continue;
    for (int i = 0; i < 3; ++i) {
      sum.d[i] += w * static_cast<float>(move.d[i]);
      sum.normal[i] += w * static_cast<float>(move.normal[i]);
    }
  }
  return sum;
}

}  // namespace caryatid::face
