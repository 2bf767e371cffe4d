#pragma once
// The kiosk's voice and what her face and body do while she speaks: takes text, runs a voice into
// the audio device, and says frame by frame what the mouth shows and which word is heard.
//
// The clock is the position that the loudspeaker has reached, never the time since say(): when
// sound stalls, mouth and captions wait with it; what comes too late is dropped, not hurried.
//
// Without a voice (none installed, language missing, crashed again and again) or without audio the
// words still pass at a reader's pace, with a still mouth: captions never depend on sound.
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/fixed.h"
#include "core/body/bap.h"
#include "core/face/fap.h"
#include "core/speech/utterance.h"

namespace caryatid::app {

struct SayOptions {
  // BCP 47 tag of the text as espeak-ng knows it: "en", "el", "de", "pt-br".
  std::string_view language = "en";
  // The text is SSML: espeak-ng's subset (speak, p, s, break, emphasis, prosody, say-as, mark, sub,
  // voice) and <lang xml:lang>, which it lacks. Otherwise angle brackets are spoken of as such.
  bool ssml = false;
  float rate = 1.0f;        // Of the voice's own speed; cut to 0.5..2.
  float pitch = 1.0f;       // Of the voice's own; cut to 0.5..2.
  float range = 1.0f;       // Of its melody; cut to 0.5..2.
  float liveliness = 1.0f;  // Of brows, head and hands on stressed words; 0 none .. 1.5.
  // A recording without its suffix: RECORDING.wav and RECORDING.timing play in place of the
  // synthesised voice. Empty: the one of SpeakerOptions::recordings, where there is one. A damaged
  // one: the voice speaks the text.
  std::string_view recording = {};
};

// What goes on in this frame. Valid until the next call.
struct SpeechFrame {
  bool speaking = false;     // From say() until the last sound has been heard.
  bool started = false;      // In this frame the first sound is heard.
  bool ended = false;        // In this frame the utterance ended, was stopped or gave up.
  bool silent = false;       // No sound: the words pass at a reader's pace.
  bool no_language = false;  // In this frame the voice said that it does not know the language.
  float played_ms = 0.0f;    // Position in the utterance that is heard now.
  int word = -1;             // Index in words() of the word that is heard; -1: none yet.
  FixedVector<FixedString<23>, 8> marks;  // Marks of the text that were passed in this frame.

  // For face::MixJob::speech: mouth FAPs are absolute; brows 31..36 and head 48..50 are added.
  face::FapFrame face;
  float mouth_strength = 0.0f;  // For face::MixJob::speech_strength.
  face::VisemeField viseme;     // The mouth as FAP 1, for streams and metrics.
  bool blink = false;           // A phrase ends: a moment to blink.
  float attention = 0.0f;       // How much the eyes are for the visitor: 1 at phrase ends.
  float breath = 0.0f;          // 0..1: lungs filled before a sentence; added to the idle breath.
  float beat = 0.0f;            // > 0 in the frame in which a hand beat of this size should start.
};

struct SpeakerOptions {
  std::string audio = "auto";  // auto, alsa, alsa:DEVICE, file:PATH.wav, null.
  std::string voice;           // Path of caryatid-voice; empty: beside this program, else PATH.
  std::string recordings;      // Folder of recordings that are named by text; empty: none.
  bool lockstep = false;       // --virtual-clock: sound advances with the frames' times.
  std::uint64_t seed = 1;
};

class Speaker {
 public:
  Speaker();
  ~Speaker();

  // Opens audio and starts the voice's process; all allocation happens here. False: `out_error` is
  // one line; the speaker then works without sound.
  bool open(const SpeakerOptions& options, std::string* out_error);

  // Says `text` (UTF-8, copied; at most kMaxSpeechBytes, longer text is cut at a word, invalid
  // bytes become U+FFFD) in place of what is being said. Never blocks, never fails: see
  // SpeechFrame::silent.
  void say(std::string_view text, const SayOptions& options);
  // Ends the utterance at once: sound off, mouth shuts within 0.2 s.
  void stop();
  // 0 silent .. 1 as recorded; ramps in 50 ms. Schedule and deployer multiply.
  void set_volume(float volume);

  // Once a frame; time_s: the kiosk's time, which rises. Moves data from the voice to the audio
  // device. No allocation; under 100 us.
  const SpeechFrame& step(double time_s);

  // Of the last step.
  const SpeechFrame& frame() const;
  // The text that is or was last spoken (as cut and mended), and its words.
  std::string_view text() const;
  std::span<const speech::Word> words() const;
  // A sign of life of the audio device. False: sound waits to be heard, and its position stood
  // still from the step before to the last one.
  bool sound_moves() const;
  // Why the last utterance is silent; one line, or empty.
  const char* trouble() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace caryatid::app
