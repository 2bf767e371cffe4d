#include "core/face/wrinkles.h"

#include <gtest/gtest.h>

namespace caryatid::face {
namespace {

constexpr auto kForehead = static_cast<std::size_t>(Wrinkle::forehead);
constexpr auto kGlabella = static_cast<std::size_t>(Wrinkle::glabella);
constexpr auto kCrowsFoot = static_cast<std::size_t>(Wrinkle::crows_foot);
constexpr auto kNasolabial = static_cast<std::size_t>(Wrinkle::nasolabial);

FapFrame with(std::initializer_list<std::pair<int, float>> values) {
  FapFrame f;
  for (const auto& [fap, value] : values) f.set(fap, value);
  return f;
}

TEST(Wrinkles, ANeutralFaceIsSmooth) { EXPECT_EQ(wrinkles_of(FapFrame{}), Wrinkles{}); }

TEST(Wrinkles, RaisedBrowsFoldTheForeheadAlone) {
  const Wrinkles w = wrinkles_of(with({{31, 200}, {33, 200}, {35, 150}}));
  EXPECT_GT(w.left[kForehead], 0.9f);
  EXPECT_EQ(w.left[kGlabella], 0.0f);
  EXPECT_EQ(w.left[kCrowsFoot], 0.0f);
  EXPECT_EQ(w.left[kNasolabial], 0.0f);
}

TEST(Wrinkles, SidesAreApart) {
  const Wrinkles w = wrinkles_of(with({{32, 200}, {38, 100}, {42, 200}, {54, 200}, {60, 200}}));
  EXPECT_EQ(w.left, Wrinkles{}.left);
  for (const float weight : w.right) EXPECT_GT(weight, 0.3f);
}

TEST(Wrinkles, SidesAreAlike) {
  const Wrinkles w = wrinkles_of(with({{31, 90},
                                       {32, 90},
                                       {37, 50},
                                       {38, 50},
                                       {41, 80},
                                       {42, 80},
                                       {21, 60},
                                       {22, 60},
                                       {6, 120},
                                       {7, 120},
                                       {61, 30},
                                       {62, 30}}));
  EXPECT_EQ(w.left, w.right);
}

TEST(Wrinkles, ASqueezeOrLoweredBrowsFoldTheGlabella) {
  const float squeezed = wrinkles_of(with({{37, 60}})).left[kGlabella];
  EXPECT_GT(squeezed, 0.2f);
  EXPECT_GT(wrinkles_of(with({{37, 60}, {31, -80}, {33, -100}})).left[kGlabella], squeezed);
}

TEST(Wrinkles, ABlinkFoldsNothing) {
  EXPECT_EQ(wrinkles_of(with({{19, 1024}, {20, 1024}, {21, 20}, {22, 20}})), Wrinkles{});
}

TEST(Wrinkles, ASquintFoldsTheCornersOfTheEyes) {
  EXPECT_GT(wrinkles_of(with({{19, 300}, {21, 130}})).left[kCrowsFoot], 0.3f);
}

TEST(Wrinkles, InnerLipsDoAsWellAsOuterOnes) {
  EXPECT_EQ(wrinkles_of(with({{6, 150}, {12, 200}})).left[kNasolabial],
            wrinkles_of(with({{53, 150}, {59, 200}})).left[kNasolabial]);
}

TEST(Wrinkles, WeightsRiseWithTheirFapsAndStayWithinOne) {
  for (const int fap : {31, 33, 35, 37, 41, 21, 53, 59, 61}) {
    Wrinkles before = wrinkles_of(FapFrame{});
    for (float value = -2000; value <= 2000; value += 20) {
      const Wrinkles now = wrinkles_of(with({{fap, value}}));
      for (std::size_t i = 0; i < kWrinkleCount; ++i) {
        EXPECT_GE(now.left[i], 0.0f) << fap;
        EXPECT_LE(now.left[i], 1.0f) << fap;
        EXPECT_TRUE(value <= 0 || now.left[i] >= before.left[i]) << fap << " at " << value;
      }
      before = now;
    }
  }
}

}  // namespace
}  // namespace caryatid::face
