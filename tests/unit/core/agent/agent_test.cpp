#include "core/agent/agent.h"

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

namespace caryatid::agent {
namespace {

constexpr float kFrame_s = 1.0f / 30.0f;

Programme two_buttons() {
  Programme p;
  for (const auto& [name, feel] : {std::pair{std::string_view("joy"), emotion::Emotion::joy},
                                   std::pair{std::string_view("calm"), emotion::Emotion::calm}})
    EXPECT_TRUE(p.buttons.push({FixedString<31>(name), feel}));
  return p;
}

TEST(Agent, FindsButtonsByName) {
  const Programme p = two_buttons();
  EXPECT_EQ(p.find(std::string_view("calm")), 1);
  EXPECT_EQ(p.find(std::string_view("cal")), -1);
}

TEST(Agent, ReactsInTheFrameOfThePress) {
  const Programme p = two_buttons();
  Agent agent(&p, 1);
  agent.step(kFrame_s, {});
  const ButtonEvent press{1, true, 0};
  const Intentions& i = agent.step(kFrame_s, {&press, 1});
  EXPECT_EQ(i.emotion, emotion::Emotion::joy);
  EXPECT_GT(i.emotions[1], 0.05f);
  EXPECT_TRUE(i.busy);
}

TEST(Agent, ReleasesAndUnknownButtonsDoNothing) {
  const Programme p = two_buttons();
  Agent agent(&p, 1);
  const ButtonEvent events[] = {{1, false, 0}, {0, true, 0}, {77, true, 0}};
  EXPECT_EQ(agent.step(kFrame_s, events).emotion, emotion::Emotion::calm);
  EXPECT_FALSE(agent.step(kFrame_s, events).busy);
}

TEST(Agent, ALongStallOrAWrongClockDoesNotMakeItJump) {
  const Programme p = two_buttons();
  Agent agent(&p, 1);
  const ButtonEvent press{1, true, 0};
  agent.step(kFrame_s, {&press, 1});
  agent.step(3600.0f, {});
  EXPECT_EQ(agent.step(-5.0f, {}).emotion, emotion::Emotion::joy);
  EXPECT_EQ(agent.step(std::numeric_limits<float>::quiet_NaN(), {}).emotion, emotion::Emotion::joy);
}

TEST(Agent, HeldFeelingOfAnotherProgramStays) {
  const Programme p = two_buttons();
  Agent agent(&p, 1);
  agent.feel(emotion::Emotion::fear, 0.5f);
  for (int i = 0; i < 3000; ++i) agent.step(kFrame_s, {});
  EXPECT_NEAR(agent.step(kFrame_s, {}).emotions[4], 0.5f, 1e-4f);
}

}  // namespace
}  // namespace caryatid::agent
