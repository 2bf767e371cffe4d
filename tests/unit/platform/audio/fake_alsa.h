#pragma once
// A sound device for tests, linked in place of libasound: plays at its rate by the monotonic clock,
// and goes wrong when told to.
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace caryatid::platform {

struct FakeAlsa {
  std::atomic<bool> plugged{true};
  std::atomic<bool> mono{true};       // false: two channels only.
  std::atomic<bool> stuck{false};     // Takes nothing any more.
  std::atomic<int> underruns_due{0};  // So many of the next writes fail with EPIPE.
  std::atomic<int> opens{0}, recovers{0};
  std::mutex mutex;
  std::vector<std::int16_t> played;  // The left channel of all that was written.

  static FakeAlsa& get();
  void reset();
};

}  // namespace caryatid::platform
