#pragma once
// The mood and the life of the person: what the guide or another program asks for goes in, what the
// body shall show comes out. Pure function of (state, time step, calls); its randomness comes from
// the seed, so a recorded script replays bit for bit.
#include "core/agent/idle.h"
#include "core/body/gesture.h"
#include "core/emotion/feeling.h"

namespace caryatid::agent {

// What the person shall show in the coming frame. Valid until the next step.
struct Intentions {
  emotion::Weights emotions{};
  emotion::Emotion emotion = emotion::Emotion::calm;  // That was asked for last and is still up.
  face::FapFrame idle_face;                           // For face::MixJob::idle.
  body::BapFrame body;
  body::GestureKind gesture = body::GestureKind::none;  // That begins in this frame.
  bool gesture_right = false;                           // A pointing one is to her right.
  bool covers_change = false;  // A blink or saccade: the moment to change a level of detail.
  bool pressed = false;        // A known button went down in this step.
  bool busy = false;           // Somebody is there: within kBusy_s of a press, or an emotion is up.
  bool asleep = false;         // The kiosk is closed: she shall leave.
};

// The person counts as visited for so long after the last press.
inline constexpr float kBusy_s = 20.0f;
// Who is visited looks friendly between two feelings: so much joy, less by what else is felt.
inline constexpr float kFriendly = 0.3f;

class Agent {
 public:
  // seed: same seed, same life.
  explicit Agent(std::uint64_t seed) : idle_(seed) {}

  // A visitor pressed a button that is known.
  void press();
  // An emotion as a button brings it: it comes and goes; again within 2 s for more of it.
  void feel(emotion::Emotion e);
  // The same for other programs of the deployer (--control): held at a strength 0..1.
  void feel(emotion::Emotion e, float strength);
  // At a phrase's end, say.
  void blink() { idle_.blink_now(); }
  // Who speaks looks at the listener: at least so much, 0..1, until it is told otherwise.
  void attend(float attention) { attend_ = attention; }
  // Begins with the next step.
  void gesture(body::GestureKind kind, bool right = false) {
    gesture_ = kind;
    out_.gesture_right = right;
  }
  void sleep(bool asleep) { out_.asleep = asleep; }

  // Advances by dt_s (clamped to 0..0.25: a stalled board does not make the person jump). O(1).
  const Intentions& step(float dt_s);

  emotion::Emotion emotion() const { return out_.emotion; }
  // What the face is on its way to: what a sentence that begins now is spoken with.
  emotion::Weights mood() const;

 private:
  emotion::Feeling feeling_;
  IdleLife idle_;
  float since_press_s_ = 1e6f;
  float attend_ = 0.0f;
  float friendly_ = 0.0f;
  bool pressed_ = false;
  body::GestureKind gesture_ = body::GestureKind::none;
  Intentions out_;
};

}  // namespace caryatid::agent
