#pragma once
// An utterance as a whole: its sound and what is said when. Made by the kiosk's own voice program
// or read from a recording and its timing file.
#include <cstdint>
#include <string>
#include <vector>

#include "core/speech/utterance.h"

namespace caryatid::tool {

struct SpokenEvent {
  enum class Kind { phone, word, mark, sentence };
  Kind kind = Kind::phone;
  std::int32_t time_ms = 0;
  std::uint32_t begin_byte = 0, end_byte = 0;  // Of a word in the text.
  std::string text;                            // IPA of a phone, name of a mark.
};

struct Spoken {
  std::uint32_t rate_hz = 22050;
  std::vector<std::int16_t> samples;
  std::vector<SpokenEvent> events;  // Times rise.
  std::int32_t end_ms = 0;
};

struct VoiceJob {
  std::string text, language = "en";
  bool ssml = false;
  double rate = 1.0, pitch = 1.0, range = 1.0;
  std::string program = {};  // Path of caryatid-voice; empty: beside this tool.
};

// Throws std::runtime_error, one line: no program, no such language, a text too long.
Spoken speak(const VoiceJob& job);

// The phones and words around `now_ms`, as core's timeline takes them (it forgets what it has
// heard).
void fill_utterance(const Spoken& spoken, std::int32_t now_ms, speech::Utterance* out);

void write_wav(const Spoken& spoken, const std::string& path);
// A WAV or FLAC by its first bytes. Throws, one line.
Spoken read_recording(const std::string& path);
// Any WAV of platform/audio/wav.h, mixed down to one channel; no events. Throws, one line.
Spoken read_wav(const std::string& path);
// The text of a timing file (platform/voice/recorded/recorded.h).
std::string timing_text(const Spoken& spoken);
// Reads one into `io`. Throws, one line.
void read_timing(const std::string& path, Spoken* io);

}  // namespace caryatid::tool
