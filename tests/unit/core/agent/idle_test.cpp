#include "core/agent/idle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace caryatid::agent {
namespace {

constexpr float kFrame_s = 1.0f / 30.0f;

// Starts of all blinks in ten minutes.
std::vector<float> blink_times(std::uint64_t seed) {
  IdleLife life(seed);
  std::vector<float> times;
  float before = 0.0f;
  for (float t = 0; t < 600.0f; t += kFrame_s) {
    life.step(kFrame_s, 0.5f);
    if (life.blink() > 0.0f && before == 0.0f) times.push_back(t);
    before = life.blink();
  }
  return times;
}

TEST(IdleLife, BlinksAtHumanRates) {
  const auto times = blink_times(7);
  EXPECT_GT(times.size(), 80u);   // 8 a minute
  EXPECT_LT(times.size(), 250u);  // 25 a minute
  float longest = 0.0f;
  for (std::size_t i = 1; i < times.size(); ++i)
    longest = std::max(longest, times[i] - times[i - 1]);
  EXPECT_LT(longest, 15.0f);
}

TEST(IdleLife, BlinkIntervalsAreNotPeriodic) {
  const auto times = blink_times(7);
  double mean = 0.0, square = 0.0;
  const auto n = static_cast<double>(times.size() - 1);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double d = times[i] - times[i - 1];
    mean += d / n;
    square += d * d / n;
  }
  EXPECT_GT(std::sqrt(square - mean * mean) / mean, 0.35);
}

TEST(IdleLife, SameSeedSameLife) {
  IdleLife a(3), b(3), c(4);
  bool differs = false;
  for (int i = 0; i < 3000; ++i) {
    a.step(kFrame_s, 0.5f);
    b.step(kFrame_s, 0.5f);
    c.step(kFrame_s, 0.5f);
    ASSERT_EQ(a.face().value, b.face().value);
    differs = differs || a.face().value != c.face().value;
  }
  EXPECT_TRUE(differs);
}

TEST(IdleLife, BlinkShutsTheLids) {
  IdleLife life(1);
  life.blink_now();
  float shut = 0.0f;
  for (int i = 0; i < 30; ++i) {
    life.step(kFrame_s / 4, 1.0f);
    shut = std::max(shut, life.face().get(19));
  }
  EXPECT_EQ(shut, 1024.0f);
}

TEST(IdleLife, EyesHoldTheVisitorWhileTheHeadMoves) {
  IdleLife life(9);
  float worst = 0.0f;
  for (int i = 0; i < 20000; ++i) {
    life.step(kFrame_s, 1.0f);
    const face::FapFrame f = life.face();
    worst = std::max(worst, std::abs(f.get(23) + f.get(49)));  // Gaze = head + eye.
  }
  EXPECT_LT(worst,
            2.0f * 3.1416f / 180.0f * 1e5f);  // Full attention: never more than 2 degrees off.
}

TEST(IdleLife, NothingJerksBetweenFrames) {
  IdleLife life(5);
  body::BapFrame before;
  for (int i = 0; i < 20000; ++i) {
    body::BapFrame b;
    life.step(kFrame_s, 0.0f);
    life.apply(&b);
    if (i > 0) {
      for (int n = 1; n <= body::kBapCount; ++n)
        EXPECT_LT(std::abs(b.get(n) - before.get(n)), 0.4f * 3.1416f / 180.0f * 1e5f) << n;
    }
    before = b;
  }
}

TEST(IdleLife, BreathKeepsTheHeadStill) {
  IdleLife life(5);
  for (int i = 0; i < 300; ++i) {
    life.step(kFrame_s, 0.0f);
    body::BapFrame b;
    life.apply(&b);
    EXPECT_NEAR(b.get(89) + b.get(101) + b.get(71), 0.0f, 1.0f);
  }
}

}  // namespace
}  // namespace caryatid::agent
