#pragma once
// Everything that disturbs a simulated board, in one file: what the controller is up against.
// - noise: each stage's time is multiplied by a log-normal factor, deviation 4 %, every frame;
// - spikes: once in 5000 frames another process or an interrupt takes 3 ms of the CPU;
// - heat: about twice an hour clocks fall by 30 % (times * 1.43, CPU and GPU) for 3 to 10 minutes.
//   Three times of four the thermal level announces it (warm 20 s, hot 4 s before), once it does
//   not;
// - load steps: every 2 to 6 minutes others make the CPU stage 1.2 to 1.8 times as long for 10 to
//   90 s. Every second time the load is shown to the controller, half a second late.
// Host code for tests only; deterministic by seed.
#include <cstdint>

#include "core/base/random.h"
#include "core/lod/board_model.h"

namespace caryatid::sim {

class Disturbances {
 public:
  explicit Disturbances(std::uint64_t seed, bool has_fence = true);
  // The coming frame. `time_us` never falls.
  lod::Disturbance next(std::uint64_t time_us);
  // Time of the last step for the worse (throttling or load); 0 before the first.
  std::uint64_t last_step_us() const { return last_step_us_; }
  // Time of the last change of any kind.
  std::uint64_t last_change_us() const { return last_change_us_; }
  std::uint32_t step_count() const { return step_count_; }
  bool throttled() const { return throttled_; }
  // Only noise and spikes from now on; for tests that place their own steps.
  void quiet();
  void throttle_now(std::uint64_t time_us, std::uint64_t seconds, bool announced);

 private:
  void plan_heat(std::uint64_t time_us);
  void plan_load(std::uint64_t time_us);
  float log_normal();

  Random random_;
  bool has_fence_;
  std::uint64_t heat_at_us_ = 0, heat_end_us_ = 0, load_at_us_ = 0, load_end_us_ = 0;
  bool heat_announced_ = true, load_shown_ = true, throttled_ = false, loaded_ = false;
  float load_factor_ = 1.0f;
  std::uint64_t last_step_us_ = 0, last_change_us_ = 0;
  std::uint32_t step_count_ = 0, plans_ = 0;
};

}  // namespace caryatid::sim
