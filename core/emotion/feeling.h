#pragma once
// How a feeling comes and goes: onset, apex, offset (emotions.md 3.4 of the project's
// specification; onset 0.3-0.6 s, surprise 0.15 s, apex at least 0.5 s, offset 0.6-1.2 s).
//
// A press starts an onset from whatever the face shows now; a second press of the same emotion
// within kStrongerWindow_s raises it to full strength; another emotion lets the present one go
// while it comes. Pure function of (state, time step); no randomness; O(1).
#include "core/emotion/emotion.h"

namespace caryatid::emotion {

inline constexpr float kFirstStrength = 0.7f;     // One press.
inline constexpr float kFullStrength = 1.0f;      // Pressed again in time.
inline constexpr float kStrongerWindow_s = 2.0f;  // "Again" means within so many seconds.

struct Timing {
  float onset_s, apex_s, offset_s;
};
// The times of one emotion. Apex is the time that the full expression holds by itself.
Timing timing(Emotion e);

class Feeling {
 public:
  // Begins (or strengthens) an emotion; calm lets go of all.
  void feel(Emotion e);
  // Begins an emotion at a given strength 0..1, held until the next call (programmes, speech).
  void hold(Emotion e, float strength);
  // Advances by dt_s >= 0.
  void step(float dt_s);

  const Weights& weights() const { return weights_; }
  // The emotion that was asked for last and is still up; calm in and after the offset.
  Emotion current() const { return phase_ == Phase::up ? current_ : Emotion::calm; }
  float strength() const { return strength_; }

 private:
  enum class Phase : std::uint8_t { rest, up };

  Weights weights_{};
  Weights from_{};        // Where each weight started its present movement.
  Weights target_{};      // Where it goes.
  Weights clock_s_{};     // Time since it started.
  Weights duration_s_{};  // Time that the movement takes.
  Emotion current_ = Emotion::calm;
  Phase phase_ = Phase::rest;
  float strength_ = 0.0f;
  float since_press_s_ = 1e9f;
  float apex_left_s_ = 0.0f;

  void move_to(Emotion e, float target, float duration_s);
  void release_others(Emotion keep);
  void begin(Emotion e, float strength, float apex_s);
};

}  // namespace caryatid::emotion
