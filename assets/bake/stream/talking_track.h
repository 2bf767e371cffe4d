#pragma once
// A talking person as FAPs, made without a voice: visemes in the rhythm of speech, brows, blinks,
// gaze and head motion. For measuring streams and for trying faces; the same seed gives the same
// track on every machine.
#include <cstdint>
#include <vector>

#include "core/face/fap.h"

namespace caryatid::bake {

// Frames at `frames_per_second`. FAPs of mouth and tongue follow face::viseme_frame(); brows, lids,
// eyes and head (FAPs 19..26, 31..38, 48..50) follow phrases of 2-4 s. Both sides are given.
std::vector<face::FapFrame> make_talking_track(double seconds, double frames_per_second,
                                               std::uint64_t seed);

}  // namespace caryatid::bake
