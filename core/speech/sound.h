#pragma once
// Sounds of speech as a face shows them. Any language's phonemes come in as IPA and are classed by
// how they are articulated (place, manner, height, rounding), never by tables of one language.
#include <cstdint>
#include <span>

#include "core/face/fap.h"

namespace caryatid::speech {

// What must touch while the sound lasts, whatever its neighbours and the mood do.
enum class Contact : std::uint8_t {
  none,
  lips,           // p b m: shut.
  lip_teeth,      // f v: lower lip at the upper teeth.
  tongue_teeth,   // th as in thin, this: tip between the teeth.
  tongue_palate,  // t d n l: tip behind the upper teeth.
};

// How one sound looks: FAP 1's own terms (two of the 15 visemes and their blend), and what else the
// blend with its neighbours has to know.
struct Sound {
  std::uint8_t first = 0;   // 0..14, face/visemes.h; 0 is silence or no shape of its own.
  std::uint8_t second = 0;  // 0..14
  std::uint8_t blend = 63;  // 63: the first alone.
  Contact contact = Contact::none;
  bool vowel = false;
  // How firmly the sound holds its shape against its neighbours', 0..1: schwa and h little, p all.
  float hold = 0.0f;

  bool silent() const { return first == 0 && second == 0 && hold == 0.0f; }
  friend bool operator==(const Sound&, const Sound&) = default;
};

// One phoneme of a voice: a sound, or two that follow each other in its time (diphthongs,
// affricates, syllabic consonants).
struct Phoneme {
  Sound begins;
  Sound ends;             // Equal to `begins` when the phoneme is one sound.
  bool stressed = false;  // A primary stress mark stands in front.
};

// `ipa`: UTF-8 of one phoneme as espeak-ng names it, at most a few symbols. Empty text and marks
// alone are silence. Unknown symbols are skipped: a phoneme of nothing but those is a weak neutral
// sound. Invalid UTF-8 counts as unknown. O(bytes).
Phoneme phoneme_of(std::span<const char> ipa);

}  // namespace caryatid::speech
