#pragma once
// Life between the presses: blinks, saccades, breath, slight sway. None of it periodic to the eye:
// every interval is drawn anew. Deterministic for a seed and a sequence of time steps.
// Cost: O(1), no allocation.
#include "core/base/random.h"
#include "core/body/bap.h"
#include "core/face/fap.h"

namespace caryatid::agent {

// A value that drifts between random targets in [-1, 1]: a critically damped spring whose target
// changes after a random time. Velocity is continuous, so nothing jerks.
class Wander {
 public:
  // Mean time between targets; the spring settles in about half of it.
  explicit Wander(float period_s) : period_s_(period_s) {}
  float step(float dt_s, Random* random);
  float value() const { return value_; }

 private:
  float period_s_;
  float value_ = 0.0f, velocity_ = 0.0f, target_ = 0.0f, left_s_ = 0.0f;
};

// Blinks: intervals log-normal-like with a mean of 4 s (2..10 s; users of talking heads find the
// upper end calmer), closing 80 ms, opening 160 ms; one in eight is double; a large gaze shift
// often brings one, as in people (Evinger 1994).
class Blinker {
 public:
  // Lid closure 0 (open) .. 1 (shut).
  float step(float dt_s, Random* random);
  void blink_now();  // Unless a blink is under way.
  bool shut() const { return closure_ > 0.8f; }
  float closure() const { return closure_; }

 private:
  float until_next_s_ = 1.5f;
  float clock_s_ = -1.0f;  // Negative: no blink under way.
  bool double_ = false;
  float closure_ = 0.0f;
};

// Adds a breath to a body: how far the chest is open, 0..1 (a deep one a little more).
void inhale(float chest, body::BapFrame* io);

// Where the eyes look, as angles from straight ahead.
struct Gaze {
  float yaw_rad = 0.0f;    // Positive: to the figure's left.
  float pitch_rad = 0.0f;  // Positive: down.
};

// Saccades around the visitor's face with now and then a glance aside: jumps that last 21 ms + 2.2
// ms a degree (the main sequence), fixations of 0.4 to 3 s.
class Saccades {
 public:
  Gaze step(float dt_s, Random* random, float attention);
  // True in the step in which a large jump began: a moment to blink or to hide a change of detail.
  bool large_jump() const { return large_jump_; }

 private:
  Gaze from_, to_, now_;
  float clock_s_ = 0.0f, duration_s_ = 0.0f, until_next_s_ = 0.8f;
  bool large_jump_ = false;
};

// All of it, added to a face and a body.
class IdleLife {
 public:
  explicit IdleLife(std::uint64_t seed) : random_(seed) {}

  // attention: 1 holds the visitor's eyes (just pressed, speaking), 0 lets the gaze stray.
  void step(float dt_s, float attention);
  void blink_now() { blinker_.blink_now(); }
  // True while the eyes are shut or jump: changes of detail hide here.
  bool covers_change() const { return blinker_.shut() || saccades_.large_jump(); }

  // Gaze, head and brows to be added to the face; FAPs 19-22 say how far a blink shuts the lids
  // from wherever they are, 0..1024 (face::MixJob::idle).
  face::FapFrame face() const;
  // Adds breath and sway of the trunk.
  void apply(body::BapFrame* baps) const;
  float blink() const { return blinker_.closure(); }

 private:
  Random random_;
  Blinker blinker_;
  Saccades saccades_;
  Gaze gaze_;
  Wander head_yaw_{3.1f}, head_pitch_{2.7f}, head_roll_{4.3f};
  Wander sway_side_{2.9f}, sway_front_{3.7f}, brow_{5.3f};
  Gaze head_gaze_;                // The head follows the eyes, late and a little.
  float breath_phase_ = 0.0f;     // Turns.
  float breath_rate_hz_ = 0.25f;  // Drawn anew each breath.
  float breath_depth_ = 1.0f;
};

}  // namespace caryatid::agent
