#include "firmware-app/screen_care.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace caryatid::app {
namespace {

void live(ScreenCare& care, float seconds, bool busy = false, bool open = true) {
  for (int i = 0; i < static_cast<int>(seconds * 10.0f + 0.5f); ++i)
    care.step(0.1f, busy, false, open);
}

TEST(ScreenCare, WithoutConfigurationNothingIsDimmedOrSwitchedOff) {
  ScreenCare care;
  live(care, 100'000.0f);
  EXPECT_TRUE(care.screen_on());
  EXPECT_EQ(care.light(), 1.0f);
}

TEST(ScreenCare, AloneItDimsThenGoesDarkAndAPressWakesItAtOnce) {
  ScreenCare care({.dim_after_s = 60.0f, .off_after_s = 120.0f, .dim_to = 0.4f});
  live(care, 59.0f);
  EXPECT_EQ(care.light(), 1.0f);
  live(care, 10.0f);
  EXPECT_FLOAT_EQ(care.light(), 0.4f);
  EXPECT_TRUE(care.screen_on());
  live(care, 60.0f);
  EXPECT_FALSE(care.screen_on());
  care.step(0.1f, false, true);
  EXPECT_TRUE(care.screen_on());
  EXPECT_EQ(care.light(), 1.0f);
}

TEST(ScreenCare, SomebodyThereKeepsItLit) {
  ScreenCare care({.dim_after_s = 5.0f, .off_after_s = 10.0f});
  live(care, 600.0f, true);
  EXPECT_TRUE(care.screen_on());
  EXPECT_EQ(care.light(), 1.0f);
}

TEST(ScreenCare, ClosedItIsDarkButAPressBuysAMinute) {
  ScreenCare care;
  live(care, 1.0f, true, false);
  EXPECT_TRUE(care.screen_on() && care.light() < 0.8f) << "it fades";
  live(care, 3.0f, true, false);
  EXPECT_FALSE(care.screen_on());
  EXPECT_EQ(care.light(), 0.0f);
  care.step(0.1f, true, true, false);
  EXPECT_TRUE(care.screen_on());
  live(care, 59.0f, true, false);
  EXPECT_TRUE(care.screen_on());
  live(care, 5.0f, true, false);
  EXPECT_FALSE(care.screen_on());
}

TEST(ScreenCare, ThePictureWandersFarEnoughAndTooSlowlyToBeSeen) {
  ScreenCare care({.wander = 0.01f});
  float most = 0.0f, fastest = 0.0f;
  Vec2 before = care.shift();
  for (int i = 0; i < 20'000; ++i) {
    care.step(0.1f, false, false);
    most = std::max({most, std::abs(care.shift().x), std::abs(care.shift().y)});
    fastest = std::max(fastest, std::abs(care.shift().x - before.x) * 10.0f);
    before = care.shift();
  }
  EXPECT_NEAR(most, 0.02f, 1e-4f);  // In halves of the picture.
  EXPECT_LT(fastest, 0.001f);       // On 480 rows a quarter of a pixel a second.
}

TEST(ScreenCare, AClockThatJumpsBackDoesNoHarm) {
  ScreenCare care({.dim_after_s = 5.0f});
  care.step(-1e9f, false, false);
  care.step(std::nanf(""), false, false);
  live(care, 4.0f);
  EXPECT_EQ(care.light(), 1.0f);
  EXPECT_TRUE(std::isfinite(care.shift().x));
}

}  // namespace
}  // namespace caryatid::app
