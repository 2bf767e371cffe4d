#include "core/agent/agent.h"

#include <gtest/gtest.h>

#include <limits>

namespace caryatid::agent {
namespace {

constexpr float kFrame_s = 1.0f / 30.0f;

TEST(Agent, ReactsInTheFrameOfThePress) {
  Agent agent(1);
  agent.step(kFrame_s);
  agent.press();
  agent.feel(emotion::Emotion::joy);
  const Intentions& i = agent.step(kFrame_s);
  EXPECT_EQ(i.emotion, emotion::Emotion::joy);
  EXPECT_GT(i.emotions[1], 0.05f);
  EXPECT_TRUE(i.busy);
  EXPECT_TRUE(i.pressed);
  EXPECT_FALSE(agent.step(kFrame_s).pressed);
}

TEST(Agent, APressWithoutAFeelingIsAVisit) {
  Agent agent(1);
  EXPECT_FALSE(agent.step(kFrame_s).busy);
  agent.press();
  EXPECT_EQ(agent.step(kFrame_s).emotion, emotion::Emotion::calm);
  EXPECT_TRUE(agent.step(kFrame_s).busy);
}

TEST(Agent, AGestureLastsForOneStep) {
  Agent agent(1);
  agent.gesture(body::GestureKind::wave);
  EXPECT_EQ(agent.step(kFrame_s).gesture, body::GestureKind::wave);
  EXPECT_EQ(agent.step(kFrame_s).gesture, body::GestureKind::none);
}

TEST(Agent, ALongStallOrAWrongClockDoesNotMakeItJump) {
  Agent agent(1);
  agent.feel(emotion::Emotion::joy);
  agent.step(kFrame_s);
  agent.step(3600.0f);
  EXPECT_EQ(agent.step(-5.0f).emotion, emotion::Emotion::joy);
  EXPECT_EQ(agent.step(std::numeric_limits<float>::quiet_NaN()).emotion, emotion::Emotion::joy);
}

TEST(Agent, HeldFeelingOfAnotherProgramStays) {
  Agent agent(1);
  agent.feel(emotion::Emotion::fear, 0.5f);
  for (int i = 0; i < 3000; ++i) agent.step(kFrame_s);
  EXPECT_NEAR(agent.step(kFrame_s).emotions[4], 0.5f, 1e-4f);
}

TEST(Agent, LooksFriendlyToAVisitorAndToNobodyElse) {
  Agent agent(1);
  EXPECT_EQ(agent.step(kFrame_s).emotions[1], 0.0f);
  agent.press();
  for (int i = 0; i < 90; ++i) agent.step(kFrame_s);
  EXPECT_NEAR(agent.step(kFrame_s).emotions[1], kFriendly, 0.01f);
  EXPECT_EQ(agent.step(kFrame_s).emotion, emotion::Emotion::calm);
  for (int i = 0; i < 30 * 30; ++i) agent.step(kFrame_s);
  EXPECT_NEAR(agent.step(kFrame_s).emotions[1], 0.0f, 1e-3f);
}

TEST(Agent, AFullFeelingLeavesNoRoomForASmile) {
  Agent agent(1);
  agent.press();
  for (int i = 0; i < 90; ++i) agent.step(kFrame_s);
  agent.feel(emotion::Emotion::sadness, 1.0f);
  for (int i = 0; i < 90; ++i) agent.step(kFrame_s);
  EXPECT_EQ(agent.step(kFrame_s).emotions[1], 0.0f);
}

}  // namespace
}  // namespace caryatid::agent
