#include "core/face/fit.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/face/fap_fill.h"
#include "core/face/fap_table.h"

namespace caryatid::face {
namespace {

TEST(Fit, GivenFapsAreNeverTouched) {
  FapFrame frame;
  frame.set(6, 100);
  frame.set(7, -30);
  frame.set(53, 5);
  fill_from_partners(&frame);
  EXPECT_EQ(frame.get(6), 100.0f);
  EXPECT_EQ(frame.get(7), -30.0f);
  EXPECT_EQ(frame.get(53), 5.0f);
}

TEST(Fit, EmptyFrameStaysEmpty) {
  FapFrame frame;
  EXPECT_FALSE(fill_from_partners(&frame).any());
  EXPECT_FALSE(frame.mask.any());
}

TEST(Fit, EveryFapWithAPartnerIsFilledFromIt) {
  for (int fap = 3; fap <= kFapCount; ++fap) {
    const int partner = fap_info(fap).partner;
    if (partner == 0) continue;
    FapFrame frame;
    frame.set(fap, 42);
    fill_from_partners(&frame);
    EXPECT_TRUE(frame.has(partner)) << fap;
    EXPECT_EQ(frame.get(partner), 42.0f) << fap;
  }
}

TEST(Fit, CentreFapsHaveNoPartner) {
  for (const int fap : {3, 14, 15, 16, 17, 18, 43, 47, 48, 63, 64}) {
    FapFrame frame;
    frame.set(fap, 42);
    EXPECT_FALSE(fill_from_partners(&frame).any()) << fap;
  }
}

TEST(Fit, OuterLipsFollowInnerAndBack) {
  for (int inner = 4; inner <= 13; ++inner) {
    FapFrame frame;
    frame.set(inner, 70);
    fill_from_partners(&frame);
    EXPECT_EQ(frame.get(inner + 47), 70.0f) << inner;
    FapFrame back;
    back.set(inner + 47, -70);
    fill_from_partners(&back);
    EXPECT_EQ(back.get(inner), -70.0f) << inner;
  }
}

// Upper middle lowered by 80, corners raised by 40 (= lowered by -40): 4/5 * 80 - 1/5 * 40.
TEST(Fit, QuarterPointsLieBetweenMiddleAndCorner) {
  FapFrame frame;
  frame.set(4, 80);
  frame.set(12, 40);
  fill_from_partners(&frame);
  for (const int fap : {8, 9, 55, 56}) EXPECT_NEAR(frame.get(fap), 56.0f, 1e-4f) << fap;
}

// All points of a contour moved alike stay on a line: no coefficient adds or loses height.
TEST(Fit, QuarterOfALipThatMovesAsAWholeMovesWithIt) {
  FapFrame frame;
  frame.set(52, 100);
  frame.set(59, 100);
  fill_from_partners(&frame);
  EXPECT_NEAR(frame.get(57), 100.0f, 1e-4f);
}

TEST(Fit, QuarterFollowsTheMiddleAlone) {
  FapFrame frame;
  frame.set(52, 80);
  fill_from_partners(&frame);
  EXPECT_NEAR(frame.get(57), 64.0f, 1e-4f);
  EXPECT_NEAR(frame.get(10), 64.0f, 1e-4f);
  EXPECT_FALSE(frame.has(12));
}

TEST(Fit, BrowMiddleFollowsItsEnds) {
  FapFrame frame;
  frame.set(31, 100);
  frame.set(35, 50);
  fill_from_partners(&frame);
  EXPECT_EQ(frame.get(33), 75.0f);
  EXPECT_EQ(frame.get(34), 75.0f);
}

TEST(Fit, StillLipSetCountsAsLeftOut) {
  FapFrame frame;
  for (int fap = 3; fap <= kFapCount; ++fap) frame.set(fap, 0);
  frame.set(52, -200);
  fill_from_partners(&frame);
  EXPECT_EQ(frame.get(5), -200.0f);
  EXPECT_EQ(frame.get(4), 0.0f);
}

TEST(Fit, AFilledFrameDoesNotChangeAgain) {
  FapFrame frame;
  frame.set(51, 10);
  frame.set(57, 20);
  frame.set(31, 30);
  fill_from_partners(&frame);
  const FapFrame once = frame;
  EXPECT_FALSE(fill_from_partners(&frame).any());
  EXPECT_EQ(frame.value, once.value);
}

// F14 = (2 F3^2 + F3 F5) / (100 + F4), and what no number is stays absent.
TEST(Fit, RulesAreRationalPolynomials) {
  FitRule rule{};
  rule.receiver = 14;
  rule.numerator_count = 2;
  rule.denominator_count = 2;
  rule.numerator[0] = {2.0f, {3, 0}, {2, 0}};
  rule.numerator[1] = {1.0f, {3, 5}, {1, 1}};
  rule.denominator[0] = {100.0f, {0, 0}, {0, 0}};
  rule.denominator[1] = {1.0f, {4, 0}, {1, 0}};
  FapFrame frame;
  frame.set(3, 10);
  frame.set(5, -4);
  EXPECT_FALSE(apply_fit({&rule, 1}, &frame).any()) << "a sender of the denominator is absent";
  frame.set(4, 60);
  EXPECT_TRUE(apply_fit({&rule, 1}, &frame).test(14));
  EXPECT_EQ(frame.get(14), 1.0f);
  FapFrame pole = frame;
  pole.mask.set(14, false);
  pole.set(4, -100);
  EXPECT_FALSE(apply_fit({&rule, 1}, &pole).any());
  EXPECT_FALSE(pole.has(14));
}

// Another table, another face: nothing is left of the built-in rules.
TEST(Fit, RulesOfAPackReplaceTheBuiltInOnes) {
  FitRule rule{};
  rule.receiver = 7;
  rule.numerator_count = 1;
  rule.numerator[0] = {0.5f, {6, 0}, {1, 0}};
  FapFrame frame;
  frame.set(6, 100);
  fill_from_partners(&frame, fit_or_default({&rule, 1}));
  EXPECT_EQ(frame.get(7), 50.0f);
  EXPECT_FALSE(frame.has(53));
  EXPECT_EQ(fit_or_default({}).data(), default_fit().data());
}

TEST(FapLimits, OutsideValuesComeBackIntoTheirRange) {
  FapFrame frame;
  frame.set(3, 1e8f);
  frame.set(4, -1e8f);
  frame.set(5, std::numeric_limits<float>::quiet_NaN());
  frame.set(19, 1080);
  limit_to_coding_range(&frame);
  EXPECT_EQ(frame.get(3), 4320.0f);
  EXPECT_EQ(frame.get(4), -1200.0f);
  EXPECT_EQ(frame.get(5), 0.0f);
  EXPECT_EQ(frame.get(19), 1080.0f);
}

}  // namespace
}  // namespace caryatid::face
