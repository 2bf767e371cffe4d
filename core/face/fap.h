#pragma once
#include <array>
#include <cstdint>

#include "core/base/fixed.h"

namespace caryatid::face {

// MPEG-4 numbers its face animation parameters 1..68 (ISO/IEC 14496-2 annex C); arrays here are
// indexed by that number, entry 0 is unused.
inline constexpr int kFapCount = 68;
inline constexpr int kFapViseme = 1;
inline constexpr int kFapExpression = 2;

// FAP 1: two of 15 visemes (0 = none): blend/63 of the first and 1 - blend/63 of the second, so 63
// is the first alone.
struct VisemeField {
  std::uint8_t first = 0;   // 0..14
  std::uint8_t second = 0;  // 0..14
  std::uint8_t blend = 0;   // 0..63
  bool viseme_def = false;
  friend bool operator==(const VisemeField&, const VisemeField&) = default;
};

// FAP 2: two of 6 expressions (0 none, 1 joy, 2 sadness, 3 anger, 4 fear, 5 disgust, 6 surprise).
struct ExpressionField {
  std::uint8_t first = 0;             // 0..6
  std::uint8_t first_intensity = 0;   // 0..63
  std::uint8_t second = 0;            // 0..6
  std::uint8_t second_intensity = 0;  // 0..63
  bool init_face = false;
  bool expression_def = false;
  friend bool operator==(const ExpressionField&, const ExpressionField&) = default;
};

// One frame of face animation. value[n] is FAP n in its own unit: FAPU (1/1024 of the neutral
// distance named in the FAP table) for displacements, AU (1e-5 rad) for rotations. Absent values
// (mask off) hold what they held before when frames are played in sequence, and count as 0 alone.
struct FapFrame {
  std::array<float, kFapCount + 1> value{};
  BitSet<kFapCount + 1> mask;
  VisemeField viseme;          // Meaningful when mask.test(1).
  ExpressionField expression;  // Meaningful when mask.test(2).

  void set(int fap, float v) {
    value[static_cast<std::size_t>(fap)] = v;
    mask.set(static_cast<std::size_t>(fap));
  }
  float get(int fap) const { return value[static_cast<std::size_t>(fap)]; }
  bool has(int fap) const { return mask.test(static_cast<std::size_t>(fap)); }
};

}  // namespace caryatid::face
