#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <span>

namespace caryatid::platform {

// Samples from one thread to another without locks. Positions count up from 0 and never wrap in the
// life of a kiosk (64 bits). N is a power of two.
template <std::size_t N>
class SampleRing {
  static_assert((N & (N - 1)) == 0);

 public:
  // Writer: how many samples fit.
  std::size_t room() const {
    return N - static_cast<std::size_t>(written_.load(std::memory_order_relaxed) -
                                        read_.load(std::memory_order_acquire));
  }
  // Writer: takes what fits, returns how many.
  std::size_t write(std::span<const std::int16_t> samples) {
    const std::int64_t at = written_.load(std::memory_order_relaxed);
    const std::size_t n = samples.size() < room() ? samples.size() : room();
    for (std::size_t i = 0; i < n; ++i) samples_[index(at, i)] = samples[i];
    written_.store(at + static_cast<std::int64_t>(n), std::memory_order_release);
    return n;
  }
  // Reader: gives up to out.size() samples, returns how many.
  std::size_t read(std::span<std::int16_t> out) {
    const std::int64_t at = read_.load(std::memory_order_relaxed);
    const auto ready = static_cast<std::size_t>(written_.load(std::memory_order_acquire) - at);
    const std::size_t n = out.size() < ready ? out.size() : ready;
    for (std::size_t i = 0; i < n; ++i) out[i] = samples_[index(at, i)];
    read_.store(at + static_cast<std::int64_t>(n), std::memory_order_release);
    return n;
  }
  // Reader: drops everything before `position` (a value of written()).
  void skip_to(std::int64_t position) {
    if (position > read_.load(std::memory_order_relaxed))
      read_.store(position, std::memory_order_release);
  }
  std::int64_t written() const { return written_.load(std::memory_order_acquire); }
  std::int64_t taken() const { return read_.load(std::memory_order_acquire); }

 private:
  static std::size_t index(std::int64_t at, std::size_t i) {
    return (static_cast<std::size_t>(at) + i) & (N - 1);
  }

  std::array<std::int16_t, N> samples_{};
  alignas(64) std::atomic<std::int64_t> written_{0};
  alignas(64) std::atomic<std::int64_t> read_{0};
};

// 1.5 s at 22 050 Hz: longer than a frame loop stalls, and what the mouth looks ahead.
inline constexpr std::size_t kRingSamples = 32768;

// A volume that moves to its target within 50 ms, so that nothing clicks.
class VolumeRamp {
 public:
  void set(float target) { target_.store(target, std::memory_order_relaxed); }
  void apply(std::span<std::int16_t> samples, std::uint32_t rate_hz) {
    const float target = target_.load(std::memory_order_relaxed);
    const float step = 20.0f / static_cast<float>(rate_hz);
    for (std::int16_t& s : samples) {
      if (now_ < target) now_ = now_ + step < target ? now_ + step : target;
      if (now_ > target) now_ = now_ - step > target ? now_ - step : target;
      s = static_cast<std::int16_t>(static_cast<float>(s) * now_);
    }
  }

 private:
  std::atomic<float> target_{1.0f};
  float now_ = 1.0f;
};

}  // namespace caryatid::platform
