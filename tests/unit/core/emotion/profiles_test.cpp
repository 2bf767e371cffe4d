#include "core/emotion/profiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/face/mixer.h"

namespace caryatid::emotion {
namespace {

TEST(Profiles, EveryEmotionHasItsFapsInOrder) {
  for (std::size_t i = 1; i < kEmotionCount; ++i) {
    const auto p = profile(static_cast<Emotion>(i));
    ASSERT_FALSE(p.empty());
    for (std::size_t k = 1; k < p.size(); ++k)
      EXPECT_LT(p[k - 1].fap, p[k].fap) << kEmotionNames[i];
  }
  EXPECT_TRUE(profile(Emotion::calm).empty());
}

TEST(Profiles,
     SignsAreThoseOfTheThesis) {  // Table 8-3, with table 8-4's measured inner brows of anger.
  EXPECT_LT(peak_face(Emotion::anger).get(31), 0.0f);
  EXPECT_GT(peak_face(Emotion::anger).get(37), 0.0f);
  EXPECT_GT(peak_face(Emotion::sadness).get(31), 0.0f);
  EXPECT_LT(peak_face(Emotion::sadness).get(12), 0.0f);
  EXPECT_GT(peak_face(Emotion::joy).get(6), 0.0f);
  EXPECT_GT(peak_face(Emotion::joy).get(41), 0.0f);
  EXPECT_LT(peak_face(Emotion::disgust).get(4), 0.0f);
  EXPECT_LT(peak_face(Emotion::fear).get(19), 0.0f);
  EXPECT_GT(peak_face(Emotion::surprise).get(3), 885.0f - 316.0f);
}

TEST(Profiles, LipGapOfOpenMouthsIsTheMeasuredFeatureF11) {
  for (const auto& [e, f11] :
       {std::pair{Emotion::fear, 291.0f}, std::pair{Emotion::surprise, 885.0f}}) {
    float gap = 0.0f;
    for (const ProfileEntry& p : profile(e))
      if (p.fap == 4 || p.fap == 5) gap -= p.mean;
    EXPECT_NEAR(gap, f11, 1.0f);
  }
}

TEST(Profiles, FacesStayWithinOneDeviationOfTheMean) {
  for (std::size_t i = 1; i < kEmotionCount; ++i)
    for (const ProfileEntry& p : profile(static_cast<Emotion>(i)))
      EXPECT_LE(std::abs(shown_value(p) - p.mean), p.deviation + 1e-3f)
          << kEmotionNames[i] << " FAP " << int{p.fap};
}

TEST(Profiles, FacesNeedNoMending) {
  for (std::size_t i = 1; i < kEmotionCount; ++i) {
    face::FapFrame face = peak_face(static_cast<Emotion>(i));
    const face::FapFrame before = face;
    face::keep_flesh_whole(face);
    for (int fap = 3; fap <= face::kFapCount; ++fap)
      EXPECT_EQ(face.get(fap), before.get(fap)) << kEmotionNames[i] << " FAP " << fap;
  }
}

TEST(Profiles, OuterLipsAreFilledFromInner) {
  const face::FapFrame joy = peak_face(Emotion::joy);
  EXPECT_TRUE(joy.has(51));
  EXPECT_TRUE(joy.has(59));
}

TEST(Profiles, ExpressionIsLinearInItsWeights) {
  Weights half{}, full{};
  half[index_of(Emotion::fear)] = 0.5f;
  full[index_of(Emotion::fear)] = 1.0f;
  for (int fap = 3; fap <= face::kFapCount; ++fap)
    EXPECT_FLOAT_EQ(2.0f * expression(half).get(fap), expression(full).get(fap));
  EXPECT_EQ(expression(Weights{}).get(31), 0.0f);
}

TEST(Profiles, ExpressionFieldBecomesLowLevelFaps) {
  face::FapFrame f;
  f.mask.set(face::kFapExpression);
  f.expression.first = 6;  // Surprise.
  f.expression.first_intensity = 63;
  f.set(3, 7.0f);  // Sent beside it: wins.
  expand_expression(f);
  EXPECT_FALSE(f.has(face::kFapExpression));
  EXPECT_EQ(f.get(3), 7.0f);
  EXPECT_FLOAT_EQ(f.get(31), peak_face(Emotion::surprise).get(31));
}

}  // namespace
}  // namespace caryatid::emotion
