#pragma once
// The budget controller: how fine, how sharp and how often to draw, so that no frame is late.
#include <array>
#include <cstdint>

#include "core/lod/board_model.h"
#include "core/lod/frame.h"
#include "core/lod/stage_model.h"

namespace caryatid::lod {

struct LodConfig {
  float vblank_us = 1e6f / 60.0f;       // Of the display mode.
  std::uint16_t vblanks_per_frame = 2;  // The target: 2 for 30 frames/s at 60 Hz, 1 for 60. >= 1.
  BoardCosts prior;                     // boards()[0] when nothing is known; the fit does the rest.
};

// Predicts instead of reacting: two StageModels say what the coming frame would cost with the
// present decision and the coming needs (a camera that moves in is known before it is drawn); the
// decision changes only when that prediction leaves a dead zone.
//
// Limits of a frame, with s the deviation of its whole cost: planned at deadline / (1 + 4.5 s),
// reduced when predicted beyond deadline / (1 + 3.2 s). Between both nothing happens.
//
// Levers, in the order in which they are pulled: triangles (shared by weight), then the rungs
// (render scale and shading together, best first), then the frame rate: the rate only when nobody
// looks and the board is warm, when it is critical (10 Hz), or when nothing else is left.
// In a hurry the rungs go first, because they act in the very next frame while records take time.
//
// Why it cannot oscillate, whatever it is fed: reductions only go down; a refinement comes at least
// `wait` after the last change; when a reduction follows within 30 s, the refinement was a mistake
// and `wait` doubles, from 2 s up to 64 s, back to 2 s only after 120 s without a reduction. So a
// load that comes and goes faster than that gets one pair of changes a minute in the end, and the
// frames in between run at the lower level; a slower one is followed. Two changes within a second
// only in the wake of a step or under a moving camera.
//
// Fixed memory (under 1 KiB), no clock, no randomness: same samples, same decisions, bit for bit.
// Cost: about 0.5 us a step on a PC with 32 objects, some 5 us when the decision changes.
class BudgetController {
 public:
  explicit BudgetController(const LodConfig& config);

  // `sample`: the last frame. `needs`: the coming one; borrowed for the call. The reference stays
  // valid and is overwritten by the next step.
  const LodDecision& step(const FrameSample& sample, const SceneNeeds& needs);
  // The first decision, before anything was drawn: planned at 70 % of the deadline by the prior.
  const LodDecision& begin(const SceneNeeds& needs);
  const LodDecision& decision() const { return decision_; }

  const StageModel& cpu() const { return cpu_; }
  const StageModel& gpu() const { return gpu_; }

 private:
  struct Plan {  // A candidate decision.
    std::array<std::uint32_t, kMaxObjects> triangles{};
    std::uint32_t triangle_sum = 0;
    int rung = 0;
    bool comfortable = false;  // Enough triangles to spend pixels on them.
  };
  struct Limits {
    float deadline_us, plan_us, reduce_us, hurry_us;
  };
  using Needs = std::array<ObjectNeed, kMaxObjects>;

  void advance_clock(const FrameSample& sample, const SceneNeeds& needs);
  void follow_camera(const SceneNeeds& needs, float passed_s);
  void learn(const FrameSample& sample);
  void learn_overhead(const FrameSample& sample);
  void note_step(float factor);
  void learn_gpu(const FrameSample& sample, bool evidence);
  float predict_now(const Work& work) const;
  float predict(const Work& work) const;
  Limits limits(const Work& work) const;
  Work work_of(std::span<const std::uint32_t> triangles, int rung, const SceneNeeds& needs) const;
  Plan plan_at(int rung, float limit_us, float comfort, const SceneNeeds& needs,
               std::span<const ObjectNeed> capped) const;
  Plan best_plan(int first_rung, float limit_us, const SceneNeeds& needs,
                 std::span<const ObjectNeed> capped) const;
  std::span<const ObjectNeed> cap(const SceneNeeds& needs, float share, float growth,
                                  Needs& storage) const;
  bool at_floor(const SceneNeeds& needs) const;
  bool reduce(const FrameSample& sample, const SceneNeeds& needs);
  bool worth_refining(const Plan& goal, float limit_us, const SceneNeeds& needs) const;
  bool moved_far(const Plan& goal, std::size_t count) const;
  bool refine(const SceneNeeds& needs);
  bool adjust_rate(const SceneNeeds& needs);
  void note_reduction();
  void adopt(const Plan& plan, Change change, bool at_once);
  void pace(const FrameSample& sample, const SceneNeeds& needs);

  LodConfig config_;
  StageModel cpu_, gpu_;
  LodDecision decision_;
  int rung_ = 0;
  float covered_px_ = 0, trend_px_s_ = 0, approach_ = 1;  // Of all objects at render scale 1.
  float overhead_us_ = 0;  // Makes up for late frames that cpu and gpu do not explain.
  ThermalLevel thermal_ = ThermalLevel::normal;
  std::uint8_t other_load_percent_ = 0;
  bool late_ = false, started_ = false, bulk_ = false, saving_ = false, blind_ = false;
  std::uint64_t last_time_us_ = 0;
  // Seconds, saturating far beyond every threshold.
  float since_change_s_ = 0, since_refine_s_ = kLong, since_reduce_s_ = kLong, since_try_s_ = 0;
  float since_unexplained_s_ = kLong, since_late_s_ = kLong, since_step_s_ = kLong, idle_s_ = 0,
        evidence_s_ = 0, wait_s_ = 2;
  static constexpr float kLong = 1e6f;
};

// The rungs, best first.
struct Rung {
  float render_scale;
  Shading shading;
};
inline constexpr std::array<Rung, 7> kRungs{{{1.0f, Shading::per_pixel},
                                             {0.875f, Shading::per_pixel},
                                             {0.75f, Shading::per_pixel},
                                             {0.75f, Shading::per_vertex},
                                             {0.625f, Shading::per_vertex},
                                             {0.5f, Shading::per_vertex},
                                             {0.5f, Shading::cheapest}}};

}  // namespace caryatid::lod
