#include "tests/board_sim/disturbances.h"

#include <array>
#include <cmath>

namespace caryatid::sim {
namespace {

constexpr double kNoiseDeviation = 0.04;
constexpr std::uint32_t kSpikeOneIn = 5000;
constexpr float kSpikeUs = 3000.0f;
constexpr float kThrottled = 1.0f / 0.7f;
constexpr std::uint64_t kSecond = 1'000'000, kNever = ~std::uint64_t{0};
constexpr std::uint64_t kWarmBefore = 20 * kSecond, kHotBefore = 4 * kSecond,
                        kWarmAfter = 20 * kSecond;

// Inverse of the normal distribution by bisection of erfc; exact to 1e-12, used once per entry.
double normal_quantile(double p) {
  double low = -8.0, high = 8.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return low;
}

// 65536 equally likely quantiles: drawing one is a log-normal draw, without libm in the loop.
const std::array<float, 65536>& log_normal_table() {
  static const std::array<float, 65536> table = [] {
    std::array<float, 65536> t{};
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = static_cast<float>(
          std::exp(kNoiseDeviation * normal_quantile((static_cast<double>(i) + 0.5) / 65536.0)));
    return t;
  }();
  return table;
}

}  // namespace

Disturbances::Disturbances(std::uint64_t seed, bool has_fence)
    : random_(seed), has_fence_(has_fence) {
  plan_heat(0);
  plan_load(0);
}

void Disturbances::quiet() {
  heat_at_us_ = load_at_us_ = heat_end_us_ = load_end_us_ = kNever;
  throttled_ = loaded_ = false;
}

void Disturbances::throttle_now(std::uint64_t time_us, std::uint64_t seconds, bool announced) {
  heat_at_us_ = time_us;
  heat_end_us_ = time_us + seconds * kSecond;
  heat_announced_ = announced;
}

void Disturbances::plan_heat(std::uint64_t time_us) {
  heat_at_us_ = time_us + (900 + random_.next() % 1800) * kSecond;
  heat_end_us_ = heat_at_us_ + (180 + random_.next() % 420) * kSecond;
  heat_announced_ = ++plans_ % 4 != 0;
}

void Disturbances::plan_load(std::uint64_t time_us) {
  load_at_us_ = time_us + (120 + random_.next() % 240) * kSecond;
  load_end_us_ = load_at_us_ + (10 + random_.next() % 80) * kSecond;
  load_factor_ = random_.between(1.2f, 1.8f);
  load_shown_ = !load_shown_;
}

float Disturbances::log_normal() { return log_normal_table()[random_.next() >> 16]; }

lod::Disturbance Disturbances::next(std::uint64_t time_us) {
  const bool throttled = time_us >= heat_at_us_ && time_us < heat_end_us_;
  const bool loaded = time_us >= load_at_us_ && time_us < load_end_us_;
  if (throttled != throttled_ || loaded != loaded_) {
    last_change_us_ = time_us;
    if ((throttled && !throttled_) || (loaded && !loaded_)) {
      last_step_us_ = time_us;
      ++step_count_;
    }
    throttled_ = throttled;
    loaded_ = loaded;
  }
  lod::Disturbance out;
  out.has_fence = has_fence_;
  out.cpu_factor = log_normal() * (throttled ? kThrottled : 1.0f) * (loaded ? load_factor_ : 1.0f);
  out.gpu_factor = log_normal() * (throttled ? kThrottled : 1.0f);
  if (random_.next() % kSpikeOneIn == 0) out.spike_us = kSpikeUs;
  if (throttled) {
    out.thermal = heat_announced_ ? lod::ThermalLevel::hot : lod::ThermalLevel::normal;
  } else if (heat_announced_ && heat_at_us_ != kNever) {
    if (time_us >= heat_end_us_ || time_us + kWarmBefore >= heat_at_us_)
      out.thermal = lod::ThermalLevel::warm;
    if (time_us < heat_end_us_ && time_us + kHotBefore >= heat_at_us_)
      out.thermal = lod::ThermalLevel::hot;
  }
  if (loaded && load_shown_ && time_us >= load_at_us_ + kSecond / 2)
    out.other_load_percent = static_cast<std::uint8_t>(100.0f * (1.0f - 1.0f / load_factor_));
  if (heat_end_us_ != kNever && time_us >= heat_end_us_ + kWarmAfter) plan_heat(time_us);
  if (load_end_us_ != kNever && time_us >= load_end_us_) plan_load(time_us);
  return out;
}

}  // namespace caryatid::sim
