#pragma once
// The cost of one stage of a frame (CPU or GPU), fitted while running.
#include <array>
#include <cstdint>

#include "core/lod/board_model.h"

namespace caryatid::lod {

// cost = sum of gain[k] x[k], where x are the terms by the board's prior profile (GPU: fixed,
// triangles, target pixels, and fragments by shading tier, of which one is drawn at a time; CPU:
// fixed, vertices, records) and the gains start at 1.
//
// Three things change a cost, and each has its own answer:
// - Drift and a wrong prior: recursive least squares (a Kalman filter whose gains walk randomly),
//   innovations clipped at 2.5 deviations so that one spike moves little. In a direction that the
//   data do not excite (the same work every frame) the covariance stops at its start value, so it
//   never winds up.
// - A step (throttling, another process): a one-sided CUSUM each way over the standardised
//   innovations (clipped at 6). When it fires, ALL gains are multiplied by the step's mean ratio,
//   because a slower clock slows every term; an innovation twice as large as the others is left out
//   of that mean, as it is a spike. A 30 % step fires at the second frame, 10 % after about five;
//   one spike alone never does.
// - Noise: the deviation is tracked too and sets how much of a frame the controller leaves free.
//
// Gains stay in [1/8, 8], the deviation in [0.02, 0.12], whatever is fed in (0 and huge times
// included). Size: 240 bytes. Cost: about 150 multiplications a frame. No libm beyond sqrt.
class StageModel {
 public:
  // Microseconds. x: non-negative, at least one positive.
  float predict(const Terms& x) const;
  // One measured frame. `late`: it missed its flip, so a step needs less proof. `evidence`: the
  // thermal level or the other processes' load has just got worse; still less.
  // Returns the factor by which a step multiplied the gains; 1 when there was none.
  float learn(const Terms& x, float measured_us, bool late, bool evidence);

  // One frame of which only bounds are known (no fence): the cost was at most `bound_us`, or, when
  // `late`, more than it. What the model expected anyway says nothing, so a model that is too
  // pessimistic would never learn; hence after every probe_frames in time it becomes 4 % more
  // hopeful. Two unexpected late frames within 120 undo that and double probe_frames (30 s to
  // 10 min at 60/s), three hopes in a row that came true halve it.
  void learn_bound(const Terms& x, float bound_us, bool late);

  // Something else is drawn from now on (another rung): believe the next frames more than usual.
  void expect_change();

  float gain(std::size_t term) const { return gain_[term]; }
  float deviation() const;  // Relative, of one frame.
  // Product of all steps since the board was last cool.
  float slowdown() const { return slowdown_; }
  void count_slowdown_from_here() { slowdown_ = 1.0f; }

 private:
  static constexpr float kPrior = 0.09f;  // A profile's term is right to about 30 %.
  static constexpr std::array<float, kTermCount * kTermCount> diagonal(float v) {
    std::array<float, kTermCount * kTermCount> matrix{};
    for (std::size_t i = 0; i < kTermCount; ++i) matrix[i * kTermCount + i] = v;
    return matrix;
  }
  struct Run {  // CUSUM of one direction.
    float score = 0, sum = 0, largest = 0;
    int frames = 0;
    void add(float z, float e);
    float mean_ratio() const;
  };
  void fit(const Terms& x, float predicted_us, float innovation_us);
  void scale(float factor);

  std::array<float, kTermCount> gain_{1, 1, 1, 1, 1, 1};
  std::array<float, kTermCount* kTermCount> covariance_ = diagonal(kPrior);
  float variance_ = 0.04f * 0.04f;
  float slowdown_ = 1.0f;
  Run up_, down_;
  int since_late_ = 1 << 20, calm_ = 0, hopes_ = 0, probe_frames_ = 1800;
};

}  // namespace caryatid::lod
