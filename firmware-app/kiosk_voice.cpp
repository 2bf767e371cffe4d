// The kiosk's side of speech: the speaker, and what face, body and eyes do with it.
#include "core/emotion/place.h"
#include "core/speech/prosody.h"
#include "firmware-app/kiosk.h"
#include "platform/log/log.h"

namespace caryatid::app {

// A kiosk without voice or sound still shows her and her captions.
void Kiosk::open_speaker() {
  std::string error;
  const SpeakerOptions options{.audio = options_.audio,
                               .voice = options_.voice,
                               .recordings = options_.recordings,
                               .lockstep = options_.virtual_clock,
                               .seed = options_.seed};
  if (!speaker_.open(options, &error))
    platform::log(platform::Event::speech_trouble, "%s", error.c_str());
  if (!options_.say.empty()) say_plain(options_.say);
}

// As she feels at the moment.
SayOptions Kiosk::say_options(std::string_view language) const {
  const emotion::Place mood = agent_ ? emotion::place_of(agent_->mood()) : emotion::Place{};
  const speech::Prosody sounds = speech::prosody_at(mood.activation, mood.evaluation);
  return {.language = language, .rate = sounds.rate, .pitch = sounds.pitch, .range = sounds.range};
}

// What the desk's guide wants to be said.
void Kiosk::say_programme() {
  SayOptions how = say_options(desk_.voice());
  how.ssml = true;
  speaker_.say(desk_.ssml(), how);
}

// What another program wants to be said.
void Kiosk::say_plain(std::string_view text) {
  speaker_.say(text, say_options(options_.language));
  desk_.caption(speaker_.text());
}

// What she says in this frame, for the mixer; her eyes know when to blink.
const SpeechFrame& Kiosk::speak(const Tick& tick) {
  const SpeechFrame& spoken = speaker_.step(tick.time_s);
  vitals_.audio_moved = speaker_.sound_moves();
  const bool trouble = *speaker_.trouble() != '\0';
  if (trouble && !told_trouble_)
    platform::log(platform::Event::speech_trouble, "speech: %s (captions go on)",
                  speaker_.trouble());
  told_trouble_ = trouble;
  if (spoken.no_language && desk_.say_in_next_language()) {
    platform::log(platform::Event::speech_trouble, "speech: goes on in %.*s, the next language",
                  static_cast<int>(desk_.voice().size()), desk_.voice().data());
    say_programme();
  }
  if (spoken.blink) agent_->blink();
  agent_->attend(spoken.speaking ? spoken.attention : 0.0f);
  if (spoken.beat > 0.0f && stage_) stage_->beat(spoken.beat);
  return spoken;
}

SpeechMetrics Kiosk::speech_metrics() const {
  const SpeechFrame& spoken = speaker_.frame();
  SpeechMetrics m;
  m.speaking = spoken.speaking;
  m.heard_ms = spoken.played_ms;
  m.word = spoken.word;
  m.strength = spoken.mouth_strength;
  const face::VisemeField& v = spoken.viseme;
  m.viseme = v.blend >= 32 ? v.first : v.second;
  m.jaw = shown_.get(3);
  m.upper_lip = shown_.get(4);
  m.lower_lip = shown_.get(5);
  m.corner = shown_.get(6);
  m.lower_thrust = shown_.get(16);
  m.upper_thrust = shown_.get(17);
  m.tongue_forward = shown_.get(45);
  return m;
}

}  // namespace caryatid::app
