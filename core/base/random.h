#pragma once
#include <cstdint>

namespace caryatid {

// PCG32 (O'Neill 2014): 16 bytes of state, the same sequence on every machine. Randomness in core
// is always an argument, so that a recorded script replays bit for bit.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed = 1) : state_(seed + kIncrement) { next(); }

  constexpr std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + kIncrement;
    const auto xorshifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
    const auto rotation = static_cast<std::uint32_t>(old >> 59u);
    return (xorshifted >> rotation) | (xorshifted << ((32u - rotation) & 31u));
  }
  // Uniform in [0, 1).
  constexpr float unit() { return static_cast<float>(next() >> 8) * (1.0f / 16777216.0f); }
  // Uniform in [low, high).
  constexpr float between(float low, float high) { return low + (high - low) * unit(); }

 private:
  static constexpr std::uint64_t kIncrement = 1442695040888963407ull;
  std::uint64_t state_;
};

}  // namespace caryatid
