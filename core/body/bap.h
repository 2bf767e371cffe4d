#pragma once
#include <array>

#include "core/base/fixed.h"

namespace caryatid::body {

// MPEG-4 numbers its body animation parameters 1..186 (ISO/IEC 14496-2 annex C) and leaves 187..296
// for extensions; arrays here are indexed by that number, entry 0 is unused.
inline constexpr int kBapCount = 186;
inline constexpr int kBapCountExtended = 296;

// One frame of body animation. value[n] is BAP n: 1e-5 rad for rotations, mm for the root
// translation (181..183: vertical, lateral, frontal). Absent values keep what they held before when
// frames are played in sequence.
struct BapFrame {
  std::array<float, kBapCountExtended + 1> value{};
  BitSet<kBapCountExtended + 1> mask;

  void set(int bap, float v) {
    value[static_cast<std::size_t>(bap)] = v;
    mask.set(static_cast<std::size_t>(bap));
  }
  float get(int bap) const { return value[static_cast<std::size_t>(bap)]; }
  bool has(int bap) const { return mask.test(static_cast<std::size_t>(bap)); }
};

}  // namespace caryatid::body
