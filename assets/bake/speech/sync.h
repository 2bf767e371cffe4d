#pragma once
// How well a mouth that was shown fits the sound that was played: measured from the outside, by the
// frames' face parameters and the audio file alone.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/face/fap.h"

namespace caryatid::bake {

struct TimedPhone {
  double start_s = 0.0;
  std::string ipa;
};

// The mouth of one frame: the FAPs that metrics carry.
struct MouthFrame {
  double time_s = 0.0;
  float jaw = 0, upper_lip = 0, lower_lip = 0, corner = 0, lower_thrust = 0, upper_thrust = 0;
};

// Where `part` lies in `whole`, in samples, looked for around `guess` by at most `reach`; the place
// of the greatest normalised correlation. Negative: nothing there resembles it (below 0.5).
std::int64_t find_sound(std::span<const std::int16_t> whole, std::span<const std::int16_t> part,
                        std::int64_t guess, std::int64_t reach);

struct SyncReport {
  std::size_t sounds = 0;  // Changes from one viseme to another in the text.
  std::size_t seen = 0;    // Of them, those at which the mouth passes from one shape to the next.
  std::vector<double> late_s;  // Of each seen one: mouth minus sound; positive: the sound leads.
  std::vector<double> at_s;
  std::size_t bilabials = 0, shut = 0;  // p b m, and those at which the lips meet in a frame.
  std::size_t labiodentals = 0, touching = 0;  // f v, and those that reach the shape of FAP 1's 2.

  double share_within(double least_s, double most_s) const;  // Of late_s.
  double percentile_s(double percent) const;
  double drift_s_per_s() const;  // Slope of late_s over at_s.
};

// phones: as they are heard in the file, times in the frames' time. The mouth passes from shape A
// to shape B when its distance to B becomes the smaller one, linear between frames; what a frame
// shows stays until the next one, which counts as half a frame of lateness.
SyncReport measure_sync(std::span<const MouthFrame> frames, std::span<const TimedPhone> phones);

}  // namespace caryatid::bake
