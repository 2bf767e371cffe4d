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
  // Of every sound that is no silence: how late the mouth is around it. Positive: the sound leads.
  std::vector<double> late_s, at_s;
  std::size_t bilabials = 0, shut = 0;  // p b m, and those at which the lips meet in a frame.
  std::size_t labiodentals = 0, touching = 0;  // f v, and those that reach the shape of FAP 1's 2.
  std::vector<double> contact_late_s;  // Of those contacts: the first such frame minus the sound.
};

double share_within(std::span<const double> values, double least, double most);
double percentile(std::span<const double> values, double percent);
// Slope of the least squares line through the report's late_s over at_s.
double drift_s_per_s(const SyncReport& report);

// phones: as they are heard in the file, in the frames' time. The mouth's track is what the screen
// shows: each frame until the next one. The sound's track is the shape that the sounding phone
// would have alone. Within a quarter of a second around each sound the mouth is as late as the
// shift (-150 to 150 ms, by 5) that brings the two tracks nearest to each other: mouths anticipate
// and blend, so that single moments of change say little, but shifted as a whole they fit worse.
SyncReport measure_sync(std::span<const MouthFrame> frames, std::span<const TimedPhone> phones);

}  // namespace caryatid::bake
