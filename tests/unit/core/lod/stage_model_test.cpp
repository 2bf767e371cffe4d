#include "core/lod/stage_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace caryatid::lod {
namespace {

constexpr Terms kTerms{1000.0f, 4000.0f, 2000.0f, 3000.0f};

// Mean of 12 uniforms less 6 is close to normal; good enough for noise.
float noise(Random& random, float deviation) {
  float sum = -6.0f;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return 1.0f + deviation * sum;
}

StageModel settled(float factor = 1.0f) {
  StageModel model;
  Random random(3);
  for (int i = 0; i < 1000; ++i)
    model.learn(kTerms, factor * sum(kTerms) * noise(random, 0.04f), false, false);
  return model;
}

TEST(StageModel, StartsAtThePrior) { EXPECT_FLOAT_EQ(StageModel().predict(kTerms), 10000.0f); }

TEST(StageModel, LearnsFromAWrongPrior) {
  for (const float factor : {0.3f, 0.7f, 1.3f, 3.0f})
    EXPECT_NEAR(settled(factor).predict(kTerms), factor * 10000.0f, factor * 200.0f);
}

TEST(StageModel, TellsTheTermsApartWhenTheWorkVaries) {
  const Terms truth{1.2f, 0.7f, 1.3f, 0.8f, 1.4f, 0.9f};
  StageModel model;
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    Terms x{1000.0f, random.between(500, 6000), random.between(500, 4000)};
    x[3 + random.next() % 3] = random.between(500, 6000);
    float cost = 0;
    for (std::size_t k = 0; k < kTermCount; ++k) cost += truth[k] * x[k];
    model.learn(x, cost * noise(random, 0.04f), false, false);
  }
  for (std::size_t k = 1; k < kTermCount; ++k) EXPECT_NEAR(model.gain(k), truth[k], 0.06f);
}

TEST(StageModel, OneSpikeMovesLittle) {
  StageModel model = settled();
  const float before = model.predict(kTerms);
  EXPECT_EQ(model.learn(kTerms, 13000.0f, true, false), 1.0f);
  EXPECT_NEAR(model.predict(kTerms), before, 0.02f * before);
}

TEST(StageModel, AStepIsKnownAtItsSecondFrame) {
  StageModel model = settled();
  EXPECT_EQ(model.learn(kTerms, 14300.0f, true, false), 1.0f);
  EXPECT_GT(model.learn(kTerms, 14300.0f, true, false), 1.3f);
  EXPECT_NEAR(model.predict(kTerms), 14300.0f, 500.0f);
}

TEST(StageModel, AnAnnouncedStepIsKnownAtItsFirstFrame) {
  StageModel model = settled();
  EXPECT_GT(model.learn(kTerms, 14300.0f, true, true), 1.3f);
}

TEST(StageModel, AStepDownIsFound) {
  StageModel model = settled(1.4f);
  for (int i = 0; i < 20; ++i) model.learn(kTerms, 10000.0f, false, false);
  EXPECT_NEAR(model.predict(kTerms), 10000.0f, 500.0f);
}

TEST(StageModel, StaysBoundedWhateverIsFedIn) {
  StageModel model;
  Random random(9);
  for (int i = 0; i < 100000; ++i) {
    const Terms x{random.between(0, 1e4f), random.between(0, 1e5f), random.between(0, 1e5f), 0.0f};
    const std::uint32_t pick = random.next() % 4;
    const float measured = pick == 0 ? 0.0f : pick == 1 ? 4e9f : random.between(0, 1e6f);
    model.learn(x, measured, (random.next() & 1) != 0, (random.next() & 1) != 0);
    for (std::size_t k = 0; k < kTermCount; ++k) {
      ASSERT_GE(model.gain(k), 0.125f);
      ASSERT_LE(model.gain(k), 8.0f);
    }
    ASSERT_GE(model.deviation(), 0.0199f);
    ASSERT_LE(model.deviation(), 0.1201f);
  }
}

TEST(StageModel, NoiseIsMeasured) {
  StageModel model;
  Random random(4);
  for (int i = 0; i < 5000; ++i)
    model.learn(kTerms, sum(kTerms) * noise(random, 0.07f), false, false);
  EXPECT_NEAR(model.deviation(), 0.07f, 0.015f);
}

TEST(StageModel, BoundsThatAgreeTeachNothing) {
  StageModel model;
  for (int i = 0; i < 1000; ++i) model.learn_bound(kTerms, 12000.0f, false);
  for (int i = 0; i < 10; ++i) model.learn_bound(kTerms, 8000.0f, true);
  EXPECT_FLOAT_EQ(model.predict(kTerms), 10000.0f);
}

TEST(StageModel, OneUnexpectedLateFrameIsForgivenTwoAreNot) {
  StageModel model;
  model.learn_bound(kTerms, 12000.0f, true);
  EXPECT_FLOAT_EQ(model.predict(kTerms), 10000.0f);
  model.learn_bound(kTerms, 12000.0f, true);
  EXPECT_GT(model.predict(kTerms), 12000.0f);
}

TEST(StageModel, WithoutAFenceHopeGrowsSlowly) {
  StageModel model;
  for (int i = 0; i < 1799; ++i) model.learn_bound(kTerms, 16000.0f, false);
  EXPECT_FLOAT_EQ(model.predict(kTerms), 10000.0f);
  model.learn_bound(kTerms, 16000.0f, false);
  EXPECT_FLOAT_EQ(model.predict(kTerms), 9600.0f);
}

}  // namespace
}  // namespace caryatid::lod
