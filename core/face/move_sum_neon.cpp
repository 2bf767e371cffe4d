// On 32-bit ARM this file alone is compiled for NEON (core/rooms.cmake). It must use no inline
// function of others: the linker keeps one copy of each, and that must run on every CPU.
#include "core/face/move_sum.h"

#if defined(__ARM_NEON)
#include <arm_neon.h>

#include <cstddef>

namespace caryatid::face {

static_assert(offsetof(pack::Move, d) == 2 && offsetof(pack::Move, normal) == 8);

MoveSum sum_moves_neon(std::span<const pack::Move> moves, std::span<const float> channel_weight) {
  float32x4_t d = vdupq_n_f32(0), normal = vdupq_n_f32(0);
  const std::size_t channels = channel_weight.size();
  const float* const weights = channel_weight.data();
  const pack::Move* const end = moves.data() + moves.size();
  for (const pack::Move* move = moves.data(); move != end; ++move) {
    if (move->channel >= channels) continue;
    const float w = weights[move->channel];
    if (w < kLeastWeight && w > -kLeastWeight) continue;
    // Eight bytes from d on, and the last eight: their second half is the normal. Fourth lanes
    // hold what stands behind, and are dropped.
    const int16x4_t by = vld1_s16(move->d);
    const int8x8_t tail = vld1_s8(reinterpret_cast<const std::int8_t*>(move) + 4);
    const int16x4_t turn = vget_high_s16(vmovl_s8(tail));
    d = vaddq_f32(d, vmulq_n_f32(vcvtq_f32_s32(vmovl_s16(by)), w));
    normal = vaddq_f32(normal, vmulq_n_f32(vcvtq_f32_s32(vmovl_s16(turn)), w));
  }
  MoveSum sum;
  vst1_f32(sum.d, vget_low_f32(d));
  vst1q_lane_f32(sum.d + 2, d, 2);
  vst1_f32(sum.normal, vget_low_f32(normal));
  vst1q_lane_f32(sum.normal + 2, normal, 2);
  return sum;
}

}  // namespace caryatid::face
#endif
