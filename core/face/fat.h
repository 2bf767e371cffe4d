#pragma once
// The face animation table (FAT) while it runs: which channels of the pack a FAP frame drives, and
// how far. A channel is one interval of one FAP's piecewise-linear table (core/pack/pack.h); a
// channel without moves only tells how far its FAP may go (eyes and head are turned, not deformed).
#include <array>
#include <cstdint>
#include <span>

#include "core/base/status.h"
#include "core/face/fap.h"
#include "core/pack/pack.h"

namespace caryatid::face {

// How far along its interval a value is: 0 before `from`, 1 beyond `to`, linear between. `to` may
// lie below `from` (negative movements). NaN counts as 0.
inline float ramp(float value, float from, float to) {
  const float c = (value - from) / (to - from);
  if (!(c > 0.0f)) return 0.0f;
  return c < 1.0f ? c : 1.0f;
}

// Weight of every channel for the FAP values of `frame` (the mask is not looked at: absent values
// are 0 in a mixed frame). `out_weight` is at least channels.size() long, else out_of_capacity.
// Every finite or NaN input gives weights in 0..1. O(channels).
Status evaluate_channels(std::span<const pack::Channel> channels, const FapFrame& frame,
                         std::span<float> out_weight);

// The FAT reaches this factor beyond the working range of each FAP (assets/characters/
// fap_working_ranges.csv), so that a movement can slow down smoothly instead of stopping dead.
inline constexpr float kReach = 1.15f;

// Ends of the table for every FAP, index = FAP number, in the FAP's unit: low <= 0 <= high. Both 0:
// this face does not know the FAP.
struct FapLimits {
  std::array<float, kFapCount + 1> low{};
  std::array<float, kFapCount + 1> high{};
};
FapLimits limits_of(std::span<const pack::Channel> channels);

// `value` itself within the working range (limits / kReach), beyond it ever slower towards the
// limit, which is never passed; C1. NaN gives 0.
float soften(float value, float low, float high);

}  // namespace caryatid::face
