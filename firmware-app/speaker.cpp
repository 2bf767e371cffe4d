#include "firmware-app/speaker.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/speech/liveliness.h"
#include "core/speech/mouth.h"
#include "core/speech/text.h"
#include "platform/audio/audio.h"
#include "platform/clock/clock.h"
#include "platform/voice/recorded/recorded.h"
#include "platform/voice/voice.h"

namespace caryatid::app {
namespace {

using platform::Voice;
using platform::VoiceTrouble;

constexpr std::size_t kPiece = 1024;              // Samples moved at once.
constexpr int kFirstWait_ms = 8;                  // Once, for the first sound after say().
constexpr int kLockstepWait_ms = 3000;            // Beyond what a voice that hangs is given.
constexpr std::int64_t kPatience_us = 2'500'000;  // For a voice that starts (again).
constexpr float kOnset_s = 0.09f;                 // In which the mouth leaves the mood's shape.
constexpr std::uint32_t kRate_hz = 22050;         // espeak-ng's own.

// From one rate to another by straight lines: speech has little near the top of its band.
class Resampler {
 public:
  void start(std::uint32_t from_hz, std::uint32_t to_hz) {
    step_ = static_cast<float>(from_hz) / static_cast<float>(to_hz);
    same_ = from_hz == to_hz;
    at_ = 0.0f;
    before_ = 0;
  }
  // How many input samples give at most `out` samples.
  std::size_t input_for(std::size_t out) const {
    return same_ ? out : static_cast<std::size_t>(static_cast<float>(out - 2) * step_);
  }
  std::size_t run(std::span<const std::int16_t> in, std::span<std::int16_t> out) {
    if (same_) {
      std::copy(in.begin(), in.end(), out.begin());
      return in.size();
    }
    std::size_t n = 0;
    for (const std::int16_t sample : in) {
      for (; at_ < 1.0f && n < out.size(); at_ += step_) {
        const float a = before_, b = sample;
        out[n++] = static_cast<std::int16_t>(a + (b - a) * at_);
      }
      at_ -= 1.0f;
      before_ = sample;
    }
    return n;
  }

 private:
  float step_ = 1.0f, at_ = 0.0f;
  std::int16_t before_ = 0;
  bool same_ = true;
};

std::string beside_this_program(const char* name) {
  std::array<char, 512> path{};
  const ssize_t n = readlink("/proc/self/exe", path.data(), path.size() - 1);
  const std::string self(path.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  const std::size_t slash = self.rfind('/');
  return slash == std::string::npos ? name : self.substr(0, slash + 1) + name;
}

}  // namespace

struct Speaker::State {
  enum class Mode : std::uint8_t {
    idle,
    waiting,  // For a voice that is being started.
    voiced,
    silent,  // Words pass at a reader's pace.
  };

  explicit State(std::uint64_t seed) : life(seed) {}

  void find_recording(std::string_view named);
  bool begin_voice(std::int64_t now_us);
  void go_silent(const char* why);
  void fill(std::int64_t now_us);
  bool fill_once(std::int64_t now_us);
  void lost(Status status, std::int64_t now_us);
  void wait_for_voice(int wait_ms) const;
  void voiced_step(double time_s);
  void waiting_step(std::int64_t now_us);
  void locate(double time_s);
  void pass_marks(float from_ms);
  void shape(float dt_s, bool speaking);
  void end();

  std::unique_ptr<platform::Audio> audio;
  std::unique_ptr<Voice> synthesis, recorded;
  Voice* voice = nullptr;  // Of the present utterance.
  bool lockstep = false;
  Mode mode = Mode::idle;

  std::array<char, kMaxSpeechBytes> text{};
  std::size_t text_bytes = 0;
  std::uint32_t from_byte = 0;  // Where the voice starts (again).
  FixedString<31> language;
  FixedString<240> recording;
  FixedString<160> recordings;  // The folder.
  bool ssml = false;
  float rate = 1.0f, pitch = 1.0f, range = 1.0f;

  speech::Utterance utterance;
  speech::Mouth mouth;
  speech::Liveliness life;
  Resampler resampler;
  std::array<std::int16_t, kPiece> in{}, out{};
  std::size_t out_count = 0, out_sent = 0;
  std::int64_t written = 0, heard = 0;  // Samples of the audio device.
  bool moves = true;                    // See sound_moves().
  bool fresh = false;                   // say() was called since the last step.
  bool ending = false;                  // The next frame tells that it ended.
  std::int64_t waiting_since_us = 0;
  double silent_since_s = -1.0;
  float silent_from_ms = 0.0f;
  double last_s = 0.0;
  bool stepped = false;
  float onset = 0.0f;         // 0..1: how far the mouth is the voice's.
  face::FapFrame last_mouth;  // Held while the mouth goes back to the mood.
  FixedString<255> trouble;
  SpeechFrame frame;
};

Speaker::Speaker() : state_(std::make_unique<State>(1)) {}
Speaker::~Speaker() = default;

bool Speaker::open(const SpeakerOptions& options, std::string* out_error) {
  state_ = std::make_unique<State>(options.seed);
  State& s = *state_;
  s.lockstep = options.lockstep;
  s.recordings.assign(options.recordings);
  platform::ErrorLine error;
  platform::AudioOptions audio{
      .kind = options.audio, .rate_hz = kRate_hz, .lockstep = options.lockstep};
  bool ok = platform::open_audio(audio, s.audio, error).ok();
  if (!ok) {
    *out_error = error.c_str();
    audio.kind = "null";
    (void)platform::open_audio(audio, s.audio, error);
  }
  s.recorded = platform::make_recorded();
  const std::string path =
      options.voice.empty() ? beside_this_program("caryatid-voice") : options.voice;
  if (!platform::open_espeak_process(path.c_str(), s.synthesis, error).ok()) {
    if (ok) *out_error = error.c_str();
    ok = false;
  }
  return ok;
}

void Speaker::say(std::string_view text, const SayOptions& options) {
  State& s = *state_;
  stop();
  bool cut = false;
  s.text_bytes = speech::mend_text(text, s.text, &cut);
  s.language.assign(options.language);
  s.find_recording(options.recording);
  s.ssml = options.ssml;
  s.rate = options.rate;
  s.pitch = options.pitch;
  s.range = options.range;
  s.from_byte = 0;
  s.trouble.assign(std::string_view(cut ? "the text is too long and was cut" : ""));
  s.utterance.clear();
  s.life.begin(options.liveliness);
  s.written = s.heard = 0;
  s.out_count = s.out_sent = 0;
  s.silent_since_s = -1.0;
  s.silent_from_ms = 0.0f;
  s.frame.played_ms = 0.0f;
  s.frame.word = -1;
  s.ending = false;
  s.fresh = true;
  s.mode = State::Mode::waiting;
  const std::int64_t now_us = platform::monotonic_us();
  s.waiting_since_us = now_us;
  (void)s.begin_voice(now_us);
}

void Speaker::stop() {
  State& s = *state_;
  if (s.mode == State::Mode::idle) return;
  if (s.voice != nullptr) s.voice->cancel();
  if (s.audio) s.audio->flush();
  s.end();
}

void Speaker::State::end() {
  if (audio) audio->finish();
  mode = Mode::idle;
  ending = true;
}

void Speaker::set_volume(float volume) {
  if (state_->audio) state_->audio->set_volume(volume);
}

// The recording of the text: as named, or where there is one in the folder.
void Speaker::State::find_recording(std::string_view named) {
  recording.assign(named);
  if (!named.empty() || recordings.size() == 0) return;
  const auto name = speech::recording_name({text.data(), text_bytes}, language.span());
  char path[256];
  std::snprintf(path, sizeof path, "%s/%s.wav", recordings.c_str(), name.c_str());
  if (access(path, R_OK) != 0) return;
  recording.assign(std::string_view(path, std::strlen(path) - 4));
}

// Asks the recording, then the synthesis. False: the mode is waiting or silent now.
bool Speaker::State::begin_voice(std::int64_t now_us) {
  platform::SayJob job;
  job.text = std::string_view(text.data(), text_bytes).substr(from_byte);
  job.language = {language.c_str(), language.size()};
  job.ssml = ssml;
  job.rate = rate;
  job.pitch = pitch;
  job.range = range;
  job.recording = {recording.c_str(), recording.size()};
  voice = nullptr;
  if (recording.size() > 0 && recorded && from_byte == 0) {
    if (recorded->say(job, now_us).ok())
      voice = recorded.get();
    else
      trouble.assign(std::string_view(recorded->trouble()));
  }
  if (voice == nullptr && synthesis) {
    const Status status = synthesis->say(job, now_us);
    if (status.ok())
      voice = synthesis.get();
    else if (status.code != Code::not_ready)
      go_silent(synthesis->trouble());
  } else if (voice == nullptr) {
    go_silent("there is no voice; install caryatid-voice and espeak-ng-data");
  }
  if (voice == nullptr) return false;
  mode = Mode::voiced;
  resampler.start(voice->rate_hz(), audio->rate_hz());
  out_count = out_sent = 0;
  return true;
}

// The rest of the text passes without sound, from where the voice fell silent.
void Speaker::State::go_silent(const char* why) {
  trouble.assign(std::string_view(why));
  mode = Mode::silent;
  silent_since_s = -1.0;
  const auto known = utterance.words();
  if (!known.empty()) from_byte = std::max(from_byte, known.back().end_byte);
  if (audio) audio->finish();
}

// A voice that was lost in the middle costs its sentence: the next one is said by the voice's
// successor, or passes in silence.
void Speaker::State::lost(Status status, std::int64_t now_us) {
  const auto why = static_cast<VoiceTrouble>(status.detail);
  const bool recovers = why == VoiceTrouble::crashed || why == VoiceTrouble::hung ||
                        why == VoiceTrouble::broken_protocol;
  trouble.assign(std::string_view(voice->trouble()));
  frame.no_language = why == VoiceTrouble::no_language;
  if (!recovers) return go_silent(voice->trouble());
  const auto known = utterance.words();
  const std::uint32_t said = known.empty() ? from_byte : known.back().end_byte;
  const std::uint32_t next = speech::next_sentence({text.data(), text_bytes}, said, ssml);
  from_byte = next > from_byte ? next : static_cast<std::uint32_t>(text_bytes);
  const auto so_far_ms = static_cast<std::int32_t>(written * 1000 / audio->rate_hz());
  utterance.continue_at(so_far_ms, from_byte);
  if (from_byte >= text_bytes) return utterance.finish(0);
  mode = Mode::waiting;
  waiting_since_us = now_us;
  recording.assign({});
}

void Speaker::State::waiting_step(std::int64_t now_us) {
  if (synthesis) {
    std::size_t none = 0;
    do {
      (void)synthesis->pump(now_us, {}, &none, &utterance);
      if (synthesis->ready() && begin_voice(now_us)) return;
      if (!lockstep) break;
      // Frames do not pass while the voice starts, so that each run starts alike.
      pollfd fd{synthesis->descriptor(), POLLIN, 0};
      (void)poll(&fd, fd.fd >= 0 ? 1 : 0, 20);
      now_us = platform::monotonic_us();
    } while (mode == Mode::waiting && now_us - waiting_since_us <= kPatience_us);
  }
  if (mode == Mode::waiting && now_us - waiting_since_us > kPatience_us)
    go_silent(synthesis ? synthesis->trouble() : "there is no voice");
}

// Moves one piece from the voice towards the device. False: there is no more now.
bool Speaker::State::fill_once(std::int64_t now_us) {
  if (out_sent < out_count) {
    const std::size_t n = audio->write({out.data() + out_sent, out_count - out_sent});
    out_sent += n;
    written += static_cast<std::int64_t>(n);
    if (out_sent < out_count) return false;
  }
  if (utterance.finished() || mode != Mode::voiced) return false;
  const std::size_t want = std::min(resampler.input_for(out.size()), in.size());
  std::size_t got = 0;
  const Status status = voice->pump(now_us, {in.data(), want}, &got, &utterance);
  out_count = resampler.run({in.data(), got}, out);
  out_sent = 0;
  if (!status.ok()) lost(status, now_us);
  return got > 0;
}

void Speaker::State::wait_for_voice(int wait_ms) const {
  pollfd fd{voice->descriptor(), POLLIN, 0};
  if (fd.fd >= 0) (void)poll(&fd, 1, wait_ms);
}

// As much as the device's ring takes. In lockstep the voice is waited for, so that what is heard
// does not depend on how fast this machine is.
void Speaker::State::fill(std::int64_t now_us) {
  bool waited = false;
  for (;;) {
    while (fill_once(now_us)) {
    }
    if (mode != Mode::voiced || utterance.finished() || out_sent < out_count) break;
    if (!utterance.has_room() || voice->descriptor() < 0) break;
    const bool first = written == 0 && !waited;
    if (!lockstep && !first) break;
    wait_for_voice(lockstep ? kLockstepWait_ms : kFirstWait_ms);
    waited = true;
    now_us = platform::monotonic_us();
  }
  if (utterance.finished() && out_sent == out_count) audio->finish();
}

void Speaker::State::pass_marks(float from_ms) {
  for (const speech::Mark& m : utterance.marks()) {
    const auto at = static_cast<float>(m.time_ms);
    const bool now = at <= frame.played_ms && (at > from_ms || (at == 0.0f && frame.started));
    if (now) (void)frame.marks.push(m.name);
  }
}

void Speaker::State::voiced_step(double time_s) {
  const std::int64_t now_us = platform::monotonic_us();
  const std::int64_t audio_us = lockstep ? static_cast<std::int64_t>(time_s * 1e6 + 0.5) : now_us;
  const std::int64_t before = heard;
  heard = audio->heard(audio_us);
  moves = heard > before || heard >= written;
  if (mode == Mode::waiting) waiting_step(now_us);
  if (mode == Mode::voiced) fill(now_us);
  frame.started = before == 0 && heard > 0;
  frame.played_ms = static_cast<float>(static_cast<double>(heard) * 1000.0 / audio->rate_hz());
  utterance.forget_before(
      static_cast<std::int32_t>(frame.played_ms - 2.0f * speech::kLookAhead_ms));
  const bool all_in = utterance.finished() && out_sent == out_count;
  if (mode == Mode::voiced && all_in && heard >= written) end();
}

// Where in the utterance this frame is.
void Speaker::State::locate(double time_s) {
  if (mode == Mode::silent && silent_since_s < 0.0) {
    silent_since_s = time_s;
    silent_from_ms = frame.played_ms;
    speech::pace_words({text.data(), text_bytes}, from_byte,
                       static_cast<std::int32_t>(silent_from_ms), ssml, &utterance);
  }
  if (mode == Mode::silent) {
    frame.played_ms = silent_from_ms + static_cast<float>((time_s - silent_since_s) * 1000.0);
    if (frame.played_ms >= static_cast<float>(utterance.end_ms())) end();
  }
  frame.silent = mode == Mode::silent;
  frame.word = utterance.word_at(static_cast<std::int32_t>(frame.played_ms));
}

// Face and body of the moment.
void Speaker::State::shape(float dt_s, bool speaking) {
  const bool voiced = speaking && !frame.silent;
  const speech::Life& l = life.step(utterance, frame.played_ms, dt_s, speaking);
  const float step = dt_s / kOnset_s;
  if (voiced) {
    const speech::MouthShape m = mouth.at(utterance, frame.played_ms, dt_s * 1000.0f);
    last_mouth = m.faps;
    frame.viseme = m.viseme;
    onset = std::min(onset + step, m.strength);
    onset = std::max(onset, std::min(m.contact, m.strength));
  } else {
    frame.viseme = {};
    onset = std::max(onset - step, 0.0f);
    for (int fap = 3; fap <= 60; ++fap)  // The last shape fades; lips that were apart shut.
      if (last_mouth.has(fap)) last_mouth.set(fap, last_mouth.get(fap) * onset);
  }
  frame.mouth_strength = onset;
  frame.face = l.faps;
  for (int fap = 3; fap <= 60; ++fap)
    if (last_mouth.has(fap)) frame.face.set(fap, last_mouth.get(fap));
  frame.blink = l.blink;
  frame.attention = l.attention;
  frame.breath = l.breath;
  frame.beat = l.beat;
}

const SpeechFrame& Speaker::step(double time_s) {
  State& s = *state_;
  const auto dt_s =
      s.stepped ? std::clamp(static_cast<float>(time_s - s.last_s), 0.0f, 0.25f) : 0.0f;
  s.stepped = true;
  s.last_s = time_s;
  SpeechFrame& f = s.frame;
  f.marks.clear();
  f.started = f.ended = f.no_language = false;
  const bool was_speaking = s.mode != State::Mode::idle;
  s.moves = true;
  const float from_ms = f.played_ms;
  if (s.audio)
    s.audio->update(s.lockstep ? static_cast<std::int64_t>(time_s * 1e6 + 0.5)
                               : platform::monotonic_us());
  if (s.mode == State::Mode::idle && s.synthesis) {
    std::size_t none = 0;  // A voice that died in its sleep is started again.
    (void)s.synthesis->pump(platform::monotonic_us(), {}, &none, &s.utterance);
  }
  if (was_speaking) {
    if (s.audio && s.mode != State::Mode::silent) s.voiced_step(time_s);
    s.locate(time_s);
    s.pass_marks(from_ms);
  }
  s.fresh = false;
  f.speaking = s.mode != State::Mode::idle;
  f.ended = s.ending;
  s.ending = false;
  s.shape(dt_s, f.speaking);
  return f;
}

const SpeechFrame& Speaker::frame() const { return state_->frame; }
std::string_view Speaker::text() const { return {state_->text.data(), state_->text_bytes}; }
std::span<const speech::Word> Speaker::words() const { return state_->utterance.words(); }
bool Speaker::sound_moves() const { return state_->moves; }
const char* Speaker::trouble() const { return state_->trouble.c_str(); }

}  // namespace caryatid::app
