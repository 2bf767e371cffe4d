#pragma once
// The stage: where the person is, how she comes and goes, and how near the camera is. She walks in
// from the side, turns to the visitor, the camera comes to her head; when nobody has been there for
// long the camera backs off and she walks away, and comes again at a press or after a while.
//
// Frame: the stage's (right-handed, metres, floor y = 0, the visitor towards +Z).
// Deterministic for a seed and a sequence of steps; fixed memory; O(joints) a step.
#include "core/agent/agent.h"
#include "core/body/bap_axes.h"
#include "core/body/gesture.h"
#include "core/body/walker.h"

namespace caryatid::agent {

// Follows a target without a jerk: a critically damped spring, exact for any time step.
struct Follower {
  float value = 0.0f, velocity = 0.0f;
  // rate: 1/s; 95 % of the way takes 4.7 / rate.
  float step(float target, float rate, float dt_s);
};

struct StageSetup {
  bool walks = true;           // false: she stands in the middle from the start and stays.
  float half_width_m = 1.6f;   // What the camera sees to each side where she stands, body in view.
  Vec3 eyes_m{0, 1.6f, 0.1f};  // Midway between the eyes at rest.
  float sleep_s = 90.0f;  // Without a visitor (the agent is not busy) for so long she walks off.
  Vec3 points_at_m{0.9f, 1.35f, 0.7f};  // From her feet: where pictures are shown.
  std::uint64_t seed = 1;
};

class Stage {
 public:
  enum class Phase : std::uint8_t { away, entering, present, leaving };
  // Once away she comes back unasked after so long.
  static constexpr float kAway_s = 30.0f;
  // The neck's own limit beside the face: what is left of a turn is the eyes' and the trunk's.
  static constexpr float kNeckTurn_rad = 0.95f;

  // Borrows the skeleton.
  Stage(const body::Skeleton* skeleton, const StageSetup& setup);

  // will: of the same frame. camera_m: where the visitor looks from; eyes and head aim at it.
  void step(float dt_s, const Intentions& will, Vec3 camera_m);

  // A hand beat of this size (body/gesture.h) underlines a word, unless hands have something to do.
  void beat(float size);

  Phase phase() const { return phase_; }
  // To show: every BAP, root included, and for face::MixJob::idle the agent's idle face with the
  // gaze held on the visitor while the body turns.
  const body::BapFrame& body() const { return body_; }
  const face::FapFrame& idle_face() const { return face_; }
  // Share of the camera's way from the body to the head, for scene::blend; eased so that the
  // picture grows evenly.
  float closeness() const;
  // Midway between the eyes, smoothed: what the near camera follows.
  Vec3 eyes_m() const { return {eyes_[0].value, eyes_[1].value, eyes_[2].value}; }
  // She is under way, or the camera is: no time to save frames.
  bool moving() const;
  const body::Walker& walker() const { return walker_; }

 private:
  float edge_m() const;
  void enter();
  void come_here();
  void leave();
  void direct(float dt_s, const Intentions& will);
  void gesture(const Intentions& will);
  void add_neck(body::Axis axis, float rad);
  void turn_neck(float dt_s, Vec3 camera_m);
  void aim_eyes(float dt_s, Vec3 camera_m);

  const body::Skeleton* skeleton_;
  StageSetup setup_;
  Phase phase_ = Phase::present;
  body::Walker walker_;
  body::GestureLayer gestures_;
  emotion::Emotion gestured_ = emotion::Emotion::calm;
  bool beat_left_ = false;
  std::uint64_t entrances_ = 0;
  float side_ = 1.0f;     // From which she comes; + is her left when she faces the visitor.
  float clock_s_ = 0.0f;  // Present: without a visitor. Away: since she went.
  bool walking_off_ = false;
  bool called_ = false;  // A press has shortened this entrance.
  Follower near_;        // Camera: 0 body, 1 head.
  Follower neck_;        // Turn of the head against the trunk.
  Follower attention_;   // How much eyes and head are for the visitor: 0..1.
  Follower eyes_[3];
  body::BapFrame body_;
  face::FapFrame face_;
};

}  // namespace caryatid::agent
