#pragma once
#include <algorithm>
#include <cstdint>

namespace caryatid::platform {

// When to try a lost device again: after 0.25 s, then twice as long each time, at most 8 s. Short
// enough that a visitor hardly notices a loose plug, long enough that a missing one costs nothing.
class Retry {
 public:
  void start(std::int64_t now_us) {
    wait_us_ = kFirst_us;
    due_us_ = now_us + wait_us_;
  }
  bool due(std::int64_t now_us) const { return now_us >= due_us_; }
  void failed(std::int64_t now_us) {
    wait_us_ = std::min(2 * wait_us_, kLongest_us);
    due_us_ = now_us + wait_us_;
  }

 private:
  static constexpr std::int64_t kFirst_us = 250'000, kLongest_us = 8'000'000;
  std::int64_t wait_us_ = kFirst_us;
  std::int64_t due_us_ = 0;
};

}  // namespace caryatid::platform
