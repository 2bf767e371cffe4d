#pragma once
// What is being said: when which sound, word and mark comes, in milliseconds of the voice's own
// audio. Grows while a voice streams and is read at the position that the loudspeaker has reached.
// Fixed memory, no text of its own: words point into the text that was given to the voice.
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/speech/sound.h"

namespace caryatid::speech {

struct Phone {
  std::int32_t start_ms = 0;  // Lasts until the next one starts.
  Phoneme phoneme;
};

struct Word {
  std::uint32_t begin_byte = 0,
                end_byte = 0;  // Half open, in the UTF-8 text as given, tags and all.
  std::int32_t start_ms = 0;
  // The next word's start or a pause before it; -1 until that is known.
  std::int32_t end_ms = -1;
  std::int32_t stress_ms = -1;  // Where its stressed sound starts; negative: it has none.
  bool stressed() const { return stress_ms >= 0; }
};

// A <mark name="..."/> of the text: gestures, pictures and what else the programme ties to a word.
struct Mark {
  FixedString<23> name;
  std::int32_t time_ms = 0;
};

// The timeline of one utterance. Times never fall: one that lies before its predecessor (a voice's
// rounding) is moved up to it. Phones that were heard make room for later ones, so that length does
// not matter; words and marks beyond the capacity are dropped and counted.
class Utterance {
 public:
  // Forgets everything: a new utterance begins.
  void clear() { *this = Utterance{}; }

  // out_of_capacity: there is no room for a phone that has not been heard (see forget_before); the
  // caller waits with what follows.
  Status add_phone(std::int32_t start_ms, const Phoneme& phoneme);
  void add_word(std::int32_t start_ms, std::uint32_t begin_byte, std::uint32_t end_byte);
  void add_mark(std::int32_t time_ms, std::span<const char> name);
  // A sentence starts: room for a breath before it.
  void add_sentence(std::int32_t start_ms);
  // Nothing follows; the voice's audio is `end_ms` long.
  void finish(std::int32_t end_ms);

  // What is added from now on counts from this time and this byte of the text: another voice, or
  // the same one again, goes on where the first one fell silent. Undoes finish().
  void continue_at(std::int32_t base_ms, std::uint32_t base_byte);

  // Phones and sentences that ended before `heard_ms` may be overwritten.
  void forget_before(std::int32_t heard_ms);

  std::span<const Phone> phones() const { return phones_.span(); }
  std::span<const Word> words() const { return words_.span(); }
  std::span<const Mark> marks() const { return marks_.span(); }
  std::span<const std::int32_t> sentences_ms() const { return sentences_.span(); }
  // Index of the word that is spoken at `now_ms`, kept until the next one starts; -1 before the
  // first. O(log words).
  int word_at(std::int32_t now_ms) const;
  bool finished() const { return finished_; }
  // Of the audio known so far: the last event's time, or the end when finished.
  std::int32_t end_ms() const { return end_ms_; }
  std::uint32_t dropped() const { return dropped_; }
  bool has_room() const { return phones_.size() < phones_.capacity(); }

 private:
  std::int32_t in_order(std::int32_t time_ms);

  FixedVector<Phone, kMaxPhones> phones_;
  FixedVector<Word, kMaxWords> words_;
  FixedVector<Mark, kMaxMarks> marks_;
  FixedVector<std::int32_t, kMaxSentences> sentences_;
  std::int32_t base_ms_ = 0, end_ms_ = 0;
  std::uint32_t base_byte_ = 0;
  std::uint32_t dropped_ = 0;
  bool finished_ = false;
};

}  // namespace caryatid::speech
