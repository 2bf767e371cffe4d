#pragma once
// Contacts of speech on the deformed mesh of a person: do the lips of a p meet, does the lower lip
// of an f reach the teeth, in the frames that a kiosk would show, in any mood?
#include <span>

#include "assets/bake/speech/sync.h"
#include "core/agent/person.h"
#include "core/speech/mouth.h"

namespace caryatid::bake {

// Lips meet when the inner contours are nearer than this (skin gives more), teeth are met within a
// millimetre of their edges.
inline constexpr float kLipsMeet_m = 0.5e-3f, kTeethMet_m = 1.0e-3f;

struct ContactReport {
  std::size_t bilabials = 0, shut = 0;
  std::size_t labiodentals = 0, touching = 0;
  float widest_gap_m = 0.0f;      // Of all p b m: the least gap of each in its frames.
  float farthest_teeth_m = 0.0f;  // Of all f v: the least distance of each in its frames.
};

// Speaks the phones at 30 frames a second with `mood` (added to the calm face) and measures every
// contact on `person`'s finest level. end_s: of the last phone.
ContactReport measure_contacts(std::span<const TimedPhone> phones, double end_s,
                               const face::FapFrame& mood, agent::Person* person,
                               const speech::Mouth& mouth = speech::Mouth());

}  // namespace caryatid::bake
