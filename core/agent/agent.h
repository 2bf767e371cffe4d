#pragma once
// Button events in, intentions out. Pure function of (state, time step, events); its randomness
// comes from the seed, so a recorded script replays bit for bit.
#include <span>

#include "core/agent/idle.h"
#include "core/agent/programme.h"
#include "core/emotion/feeling.h"

namespace caryatid::agent {

// What the person shall show in the coming frame. Valid until the next step.
struct Intentions {
  emotion::Weights emotions{};
  emotion::Emotion emotion = emotion::Emotion::calm;  // That was asked for last and is still up.
  face::FapFrame idle_face;                           // For face::MixJob::idle.
  body::BapFrame body;
  bool covers_change = false;  // A blink or saccade: the moment to change a level of detail.
  bool pressed = false;        // A known button went down in this step.
  bool busy = false;           // Somebody is there: within kBusy_s of a press, or an emotion is up.
};

// The person counts as visited for so long after the last press.
inline constexpr float kBusy_s = 20.0f;

class Agent {
 public:
  // programme: borrowed. seed: same seed, same life.
  Agent(const Programme* programme, std::uint64_t seed);

  // Advances by dt_s (clamped to 0..0.25: a stalled board does not make the person jump) and takes
  // the events since the last step in their order. Events of unknown buttons are ignored.
  // O(events).
  const Intentions& step(float dt_s, std::span<const ButtonEvent> events);

  // The same for other programs of the deployer (--control): an emotion at a strength 0..1.
  void feel(emotion::Emotion e, float strength);
  // At a phrase's end, say.
  void blink() { idle_.blink_now(); }

  emotion::Emotion emotion() const { return out_.emotion; }

 private:
  void press(const Button& button);

  const Programme* programme_;
  emotion::Feeling feeling_;
  IdleLife idle_;
  float since_press_s_ = 1e6f;
  Intentions out_;
};

}  // namespace caryatid::agent
