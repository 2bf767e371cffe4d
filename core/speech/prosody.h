#pragma once
// How a feeling sounds: pace, pitch and melody of the voice from its place on the plane of
// activation and evaluation.

namespace caryatid::speech {

// Factors of the voice's own.
struct Prosody {
  float rate = 1.0f;   // Words a minute.
  float pitch = 1.0f;  // Mean frequency.
  float range = 1.0f;  // Of the melody around it.
};

// activation, evaluation: -1..1; (0, 0) changes nothing. Schroeder's rules for synthesised speech
// ("Dimensional emotion representation as a basis for speech synthesis", 2004): pitch by 0.3 A +
// 0.1 E, range from 4 to 4 + 4 A semitones, rate by 0.5 A + 0.2 E, of which a visitor who has to
// follow gets half.
Prosody prosody_at(float activation, float evaluation);

}  // namespace caryatid::speech
