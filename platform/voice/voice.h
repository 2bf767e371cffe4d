#pragma once
// The service that turns text into sound and its timeline. Backends: espeak_process (synthesis in a
// program of its own), recorded (a WAV file and its timing file).
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/status.h"
#include "core/speech/utterance.h"
#include "platform/error_line.h"

namespace caryatid::platform {

struct SayJob {
  std::string_view text = {};        // Valid UTF-8, at most kMaxSpeechBytes.
  std::string_view language = "en";  // BCP 47, at most 31 bytes.
  bool ssml = false;
  float rate = 1.0f, pitch = 1.0f;  // Of the voice's own, 0.5..2.
  float range = 1.0f;               // Of its melody, the same.
  std::string_view recording = {};  // For the recorded voice: the name of its files, no suffix.
};

// Why a voice gave up (Status::detail).
enum class VoiceTrouble : std::uint16_t {
  none,
  no_program,       // The voice's program is missing or can't start.
  no_language,      // It does not know the language.
  crashed,          // It ended by itself.
  hung,             // It was asked for sound and sent nothing for 2 s.
  broken_protocol,  // It sent what no voice sends.
  refused_text,     // It can't speak this text.
  bad_recording,    // recorded: see the error line.
};
const char* voice_trouble_text(VoiceTrouble trouble);

// One utterance at a time, streamed: events come before the sound that they are about.
class Voice {
 public:
  virtual ~Voice() = default;

  // Begins; what was being said is dropped. The job's views are used during the call alone.
  // not_ready: the voice is not there (yet); io, unsupported, corrupt_data: it can't, see detail.
  virtual Status say(const SayJob& job, std::int64_t now_us) = 0;
  // Ends the utterance; nothing more of it comes.
  virtual void cancel() = 0;

  // Moves what has arrived: sound to `out_pcm` (mono), events to `io`, whose finish() tells that
  // this was all. Never blocks. Not ok: this utterance ends here (crash, hang, damage); the voice
  // recovers by itself. `out_count` is valid in any case. With `out_pcm` empty it only watches.
  virtual Status pump(std::int64_t now_us, std::span<std::int16_t> out_pcm, std::size_t* out_count,
                      speech::Utterance* io) = 0;

  // Samples a second of what pump() gives; known after say() was ok.
  virtual std::uint32_t rate_hz() const = 0;
  // True when say() can work now.
  virtual bool ready() const = 0;
  // A descriptor to poll for more, or -1.
  virtual int descriptor() const = 0;
  // What the last call that was not ok complained about: one line.
  virtual const char* trouble() const = 0;
};

// Starts the program at `path` and keeps it warm; a program that ends or hangs is started again
// after 0.25 s, then ever more slowly. Fails only when there is no such program: one error line.
Status open_espeak_process(const char* path, std::unique_ptr<Voice>& out, ErrorLine& out_error);

}  // namespace caryatid::platform
