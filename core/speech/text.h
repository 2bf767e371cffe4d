#pragma once
// The text of an utterance as bytes: made valid, cut, and walked word by word where no voice does.
#include <cstdint>
#include <optional>
#include <span>

#include "core/speech/utterance.h"

namespace caryatid::speech {

// Copies `text` into `out`, at most out.size() bytes: invalid UTF-8 becomes U+FFFD, control
// characters become blanks, and what does not fit is cut after a whole word (a whole character when
// there is no blank). Returns the bytes written; *out_cut tells whether text was left out.
// O(bytes).
std::size_t mend_text(std::span<const char> text, std::span<char> out, bool* out_cut);

// What the files of a text's recording are called in a folder of recordings: a hash of its bytes
// and the language, as "af63bd4c8601b7df-en".
FixedString<63> recording_name(std::span<const char> text, std::span<const char> language);

struct ByteRange {
  std::uint32_t begin = 0, end = 0;
};
// The next word (run of bytes between blanks and tags) at or after `from`. Tags are skipped when
// `ssml`.
std::optional<ByteRange> next_word(std::span<const char> text, std::uint32_t from, bool ssml);

// Where the sentence after the one that holds byte `from` begins; text.size() when there is none.
// Tags end no sentence and may follow its end, when `ssml`.
std::uint32_t next_sentence(std::span<const char> text, std::uint32_t from, bool ssml = false);

// Adds the words from `from_byte` on at a silent reader's pace (about 14 characters a second, the
// rate of good subtitles), from `start_ms` on, and finishes the utterance.
void pace_words(std::span<const char> text, std::uint32_t from_byte, std::int32_t start_ms,
                bool ssml, Utterance* io);

}  // namespace caryatid::speech
