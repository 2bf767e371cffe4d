#include "core/emotion/feeling.h"

#include <gtest/gtest.h>

namespace caryatid::emotion {
namespace {

constexpr float kFrame_s = 1.0f / 30.0f;

float after(Feeling* f, Emotion e, float seconds) {
  for (float t = 0; t < seconds; t += kFrame_s) f->step(kFrame_s);
  return f->weights()[index_of(e)];
}

TEST(Feeling, StartsInTheVeryNextFrame) {
  for (std::size_t i = 1; i < kEmotionCount; ++i) {
    Feeling f;
    f.feel(static_cast<Emotion>(i));
    f.step(kFrame_s);
    EXPECT_GT(f.weights()[i], 0.08f) << kEmotionNames[i];
  }
}

TEST(Feeling, OnsetApexOffset) {
  Feeling f;
  f.feel(Emotion::joy);
  EXPECT_NEAR(after(&f, Emotion::joy, timing(Emotion::joy).onset_s + kFrame_s), kFirstStrength,
              1e-4);
  EXPECT_EQ(f.current(), Emotion::joy);
  EXPECT_NEAR(after(&f, Emotion::joy, timing(Emotion::joy).apex_s - 3 * kFrame_s), kFirstStrength,
              1e-4);
  after(&f, Emotion::joy, 3 * kFrame_s);
  EXPECT_EQ(f.current(), Emotion::calm);
  EXPECT_EQ(after(&f, Emotion::joy, timing(Emotion::joy).offset_s + kFrame_s), 0.0f);
}

TEST(Feeling, AgainWithinTwoSecondsIsStronger) {
  Feeling f;
  f.feel(Emotion::fear);
  after(&f, Emotion::fear, 1.0f);
  f.feel(Emotion::fear);
  EXPECT_NEAR(after(&f, Emotion::fear, 1.0f), kFullStrength, 1e-4);
}

TEST(Feeling, AgainAfterTwoSecondsIsNot) {
  Feeling f;
  f.feel(Emotion::fear);
  after(&f, Emotion::fear, 2.2f);
  f.feel(Emotion::fear);
  EXPECT_NEAR(after(&f, Emotion::fear, 1.0f), kFirstStrength, 1e-4);
}

TEST(Feeling, AnotherEmotionReplacesWithoutAJump) {
  Feeling f;
  f.feel(Emotion::joy);
  after(&f, Emotion::joy, 1.0f);
  f.feel(Emotion::anger);
  float joy = f.weights()[index_of(Emotion::joy)];
  for (int i = 0; i < 60; ++i) {
    f.step(kFrame_s);
    const float now = f.weights()[index_of(Emotion::joy)];
    EXPECT_LE(now, joy + 1e-6f);
    EXPECT_LT(joy - now, 0.35f);
    joy = now;
  }
  EXPECT_EQ(joy, 0.0f);
  EXPECT_NEAR(f.weights()[index_of(Emotion::anger)], kFirstStrength, 1e-4);
}

TEST(Feeling, CalmLetsGo) {
  Feeling f;
  f.feel(Emotion::sadness);
  after(&f, Emotion::sadness, 1.0f);
  f.feel(Emotion::calm);
  EXPECT_EQ(f.current(), Emotion::calm);
  EXPECT_EQ(after(&f, Emotion::sadness, 1.4f), 0.0f);
}

TEST(Feeling, HeldStaysUntilTold) {
  Feeling f;
  f.hold(Emotion::joy, 0.3f);
  EXPECT_NEAR(after(&f, Emotion::joy, 60.0f), 0.3f, 1e-4);
}

TEST(Feeling, ReleasedEmotionCanBeFeltAgainBeforeItIsGone) {
  Feeling f;
  f.feel(Emotion::joy);
  after(&f, Emotion::joy, 1.0f);
  f.feel(Emotion::calm);
  after(&f, Emotion::joy, 0.2f);
  f.feel(Emotion::joy);
  EXPECT_NEAR(after(&f, Emotion::joy, 1.0f), kFirstStrength, 1e-4);
}

}  // namespace
}  // namespace caryatid::emotion
