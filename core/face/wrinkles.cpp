#include "core/face/wrinkles.h"

#include <algorithm>

namespace caryatid::face {
namespace {

// The FAPs of one side. Inner and outer lips go together when a stream has been filled.
struct Side {
  int inner_brow, middle_brow, outer_brow, squeeze, lower_lid, cheek;
  int inner_stretch, outer_stretch, inner_raise, outer_raise, nose_wing;
};
constexpr Side kLeft{31, 33, 35, 37, 21, 41, 6, 53, 12, 59, 61};
constexpr Side kRight{32, 34, 36, 38, 22, 42, 7, 54, 13, 60, 62};

// Amplitudes at which lines begin to show and are full, in the FAPs' own units: below and at the
// means of the measured expressions (thesis table 8-4; core/emotion/profiles.cpp).
struct Ramp {
  float begin, full;
  float operator()(float x) const {
    const float t = std::clamp((x - begin) / (full - begin), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
  }
};
constexpr Ramp kRaise{20.0f, 150.0f}, kFrown{15.0f, 110.0f}, kCheek{30.0f, 170.0f};
constexpr Ramp kLid{35.0f, 120.0f}, kSmile{40.0f, 260.0f}, kSneer{15.0f, 60.0f};

std::array<float, kWrinkleCount> of_side(const FapFrame& faps, const Side& side) {
  const auto up = [&faps](int fap) { return std::max(faps.get(fap), 0.0f); };
  const auto down = [&faps](int fap) { return std::max(-faps.get(fap), 0.0f); };
  const float raise =
      0.5f * up(side.inner_brow) + 0.35f * up(side.middle_brow) + 0.15f * up(side.outer_brow);
  const float frown =
      up(side.squeeze) + 0.3f * down(side.inner_brow) + 0.2f * down(side.middle_brow);
  const float stretch = std::max(up(side.inner_stretch), up(side.outer_stretch));
  const float corner = std::max(up(side.inner_raise), up(side.outer_raise));
  const float cheek = kCheek(up(side.cheek));
  const float smile = kSmile(0.6f * stretch + 0.6f * corner);
  const float sneer = kSneer(up(side.nose_wing));
  return {kRaise(raise), kFrown(frown), 0.6f * cheek + 0.4f * kLid(up(side.lower_lid)),
          1.0f - (1.0f - smile) * (1.0f - 0.5f * cheek) * (1.0f - 0.7f * sneer)};
}

}  // namespace

Wrinkles wrinkles_of(const FapFrame& faps) { return {of_side(faps, kLeft), of_side(faps, kRight)}; }

}  // namespace caryatid::face
