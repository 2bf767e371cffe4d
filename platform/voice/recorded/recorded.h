#pragma once
// A voice that was recorded, or synthesised ahead of time: NAME.wav and its timing NAME.timing.
//
// A timing file is text in lines, made by caryatid-tool speech (or by hand):
//
//   caryatid-timing 1           the first line
//   # comment
//   phone 95 ˈɛ                 milliseconds, IPA; no IPA is silence
//   word 829 10 15              milliseconds, first byte and end in the text
//   mark 900 wave               milliseconds, name
//   sentence 829                milliseconds
//   end 2338                    the last line
//
// Times rise from line to line, up to an hour.
#include "platform/voice/voice.h"

namespace caryatid::platform {

// One event of a timing file.
struct TimingLine {
  enum class Kind : std::uint8_t { none, phone, word, mark, sentence, end };
  Kind kind = Kind::none;  // none: an empty line or a comment.
  std::int32_t time_ms = 0;
  std::uint32_t begin_byte = 0, end_byte = 0;
  std::span<const char> text;  // Of the line: IPA or name.
};
// Reads one line without its end. False: it is no line of a timing file.
bool parse_timing_line(std::span<const char> line, TimingLine* out);
inline constexpr std::string_view kTimingHead = "caryatid-timing 1";

// A voice that plays SayJob::recording, whatever the job's text. say() opens and checks both files
// (about 1 ms a minute of speech): io or corrupt_data, and trouble() says which line of what;
// pump() reads as it plays. No allocation after this one.
std::unique_ptr<Voice> make_recorded();

}  // namespace caryatid::platform
