#pragma once
// Time from the board: monotonic, never the wall clock, which may jump at boot.
#include <time.h>

#include <cstdint>

namespace caryatid::platform {

inline std::int64_t monotonic_us() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1000000 + t.tv_nsec / 1000;
}

// Sleeps until the given time; returns at once when it has passed. A signal ends it early.
inline void sleep_until_us(std::int64_t time_us) {
  const timespec t{static_cast<time_t>(time_us / 1000000),
                   static_cast<long>(time_us % 1000000 * 1000)};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
}

}  // namespace caryatid::platform
