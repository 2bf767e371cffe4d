#pragma once
// A kiosk in virtual time: a visitor's day on a board, drawn under one of three policies.
#include <array>
#include <cstdint>
#include <functional>

#include "core/lod/controller.h"
#include "tests/board_sim/disturbances.h"

namespace caryatid::sim {

enum class Policy {
  controller,  // lod::BudgetController.
  fixed,       // What the controller decides at start, for ever: an artist's tuned level.
  reactive,    // Naive: a twentieth of the triangles off after a late frame, on after 30 in time.
};
const char* name_of(Policy policy);

struct Scenario {
  lod::BoardCosts board;
  std::uint16_t vblanks_per_frame = 1;
  Policy policy = Policy::controller;
  double hours = 24;
  bool has_fence = true;
  bool scene_moves = true;   // Shots change every 10 to 40 s, the camera taking 2 s for it.
  float prior_error = 0.3f;  // The controller's prior is wrong by up to this, term by term.
  std::uint64_t seed = 1;
};

struct Outcome {
  std::uint64_t frames = 0, late = 0, steps = 0;
  std::uint32_t worst_late_after_step = 0;     // Within 2 s after a load or thermal step.
  std::uint64_t changes = 0;                   // Of the decision.
  std::uint32_t most_changes_in_a_second = 0;  // Steady: nothing stepped or moved for 3 s.
  double mean_triangles = 0, mean_scale = 0, mean_us = 0;
  std::uint64_t hash = 0;  // Of every decision and flip.
  double in_time() const {
    return frames == 0 ? 0.0 : 1.0 - static_cast<double>(late) / static_cast<double>(frames);
  }
};

// One frame, for plots.
struct Trace {
  double time_s;
  double frame_us;  // CPU + GPU as they were.
  double cpu_us;
  std::uint32_t triangles;
  float render_scale;
  bool late, throttled;
  lod::ThermalLevel thermal;
  lod::Change change;
};

class Simulation {
 public:
  explicit Simulation(const Scenario& scenario);
  // Runs to the end; `watch` sees every frame where it is given.
  Outcome run(const std::function<void(const Trace&)>& watch = {});
  Disturbances& disturbances() { return disturbances_; }

 private:
  void move_scene(std::uint64_t time_us);
  void move_level(const lod::LodDecision& decision, std::uint64_t time_us, float seconds);
  void react(const lod::FrameSample& sample);
  lod::Work work_of(const lod::LodDecision& decision) const;
  void count(const lod::FrameSample& sample, const lod::LodDecision& decision, Outcome& out);

  Scenario scenario_;
  Random random_;
  Disturbances disturbances_;
  lod::VirtualBoard board_;
  lod::BudgetController controller_;
  lod::LodDecision own_;  // Of the policies that are not the controller.
  std::array<lod::ObjectNeed, 6> objects_;
  lod::SceneNeeds needs_;
  // Scene.
  double close_up_ = 1.0, close_up_from_ = 1.0, close_up_to_ = 1.0;
  std::uint64_t shot_at_us_ = 0, next_shot_us_ = 0, last_scene_us_ = 0, next_cover_us_ = 0;
  // Level as drawn, and the change under way.
  std::array<float, 6> drawn_{};
  std::uint32_t sequence_ = 0, records_ = 0;
  float held_s_ = 0, morph_s_ = 0;
  bool settled_ = true;
  // Counting.
  int calm_frames_ = 0, level_ = 20;
  std::uint32_t late_after_step_ = 0, counted_steps_ = 0, counted_sequence_ = 0;
  std::array<std::uint64_t, 64> change_us_{};
  std::size_t change_count_ = 0;
};

}  // namespace caryatid::sim
