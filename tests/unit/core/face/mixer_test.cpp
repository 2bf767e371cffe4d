#include "core/face/mixer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/face/visemes.h"

namespace caryatid::face {
namespace {

FapLimits wide() {
  FapLimits limits;
  limits.low.fill(-4000.0f);
  limits.high.fill(4000.0f);
  return limits;
}

TEST(Mixer, LipsAreTuckedInBetweenOpenTeethOnly) {
  FapFrame frame;
  frame.set(3, 0.0f);
  frame.set(16, -220.0f);
  frame.set(17, 100.0f);
  keep_lips_before_teeth(frame);
  EXPECT_GT(frame.get(16), -150.0f);
  EXPECT_EQ(frame.get(17), 100.0f);
  frame.set(3, 100.0f);
  frame.set(16, -220.0f);
  keep_lips_before_teeth(frame);
  EXPECT_EQ(frame.get(16), -220.0f);
}

TEST(Mixer, RoundedLipsHoldTheirOwnCorner) {
  FapFrame frame;
  for (const int side : {0, 1}) frame.set(12 + side, 380.0f);
  frame.set(6, -220.0f);
  frame.set(7, 100.0f);
  pucker_corners(frame);
  EXPECT_LT(frame.get(12), 200.0f);
  EXPECT_EQ(frame.get(13), 380.0f);
}

TEST(Mixer, NothingGivesTheNeutralFace) {
  const FapLimits limits = wide();
  const FapFrame out = MixJob{.limits = &limits}.run();
  for (int fap = 3; fap <= kFapCount; ++fap) EXPECT_EQ(out.get(fap), 0.0f) << fap;
}

TEST(Mixer, EmotionIsAddedToTheCalmFace) {
  const FapLimits limits = wide();
  FapFrame rest, emotion;
  rest.set(31, 20.0f);
  emotion.set(31, 100.0f);
  EXPECT_EQ((MixJob{.rest = &rest, .emotion = &emotion, .limits = &limits}.run().get(31)), 120.0f);
}

TEST(Mixer, StreamReplacesRestAndEmotion) {
  const FapLimits limits = wide();
  FapFrame rest, stream;
  rest.set(31, 20.0f);
  stream.set(31, -7.0f);
  EXPECT_EQ((MixJob{.rest = &rest, .stream = &stream, .limits = &limits}.run().get(31)), -7.0f);
}

TEST(Mixer, SpeechOwnsLipsAndJawAndLeavesTheBrows) {
  const FapLimits limits = wide();
  FapFrame emotion;
  emotion.set(5, -500.0f);
  emotion.set(31, 200.0f);
  emotion.set(12, 100.0f);
  const FapFrame closed = viseme_frame(1);
  const FapFrame out =
      MixJob{.emotion = &emotion, .speech = &closed, .speech_strength = 1.0f, .limits = &limits}
          .run();
  EXPECT_GE(out.get(4) + out.get(5), -1e-3f) << "p, b, m shut the lips whatever is felt";
  EXPECT_EQ(out.get(31), 200.0f);
  EXPECT_NEAR(out.get(12), 40.0f, 1e-3f);
}

TEST(Mixer, BlinkShutsEvenAStartledEye) {
  const FapLimits limits = wide();
  FapFrame emotion, idle;
  emotion.set(19, -250.0f);
  idle.set(19, 1024.0f);
  const FapFrame out = MixJob{.emotion = &emotion, .idle = &idle, .limits = &limits}.run();
  EXPECT_NEAR(out.get(19) + out.get(21), 1024.0f, 1e-2f);
}

TEST(Mixer, LidsFollowAGlanceDown) {
  const FapLimits limits = [] {
    FapLimits l = wide();
    l.high.fill(1e6f);
    return l;
  }();
  FapFrame idle;
  idle.set(25, 20000.0f);
  const FapFrame out = MixJob{.idle = &idle, .limits = &limits}.run();
  EXPECT_GT(out.get(19), 50.0f);
  EXPECT_LT(out.get(21), -20.0f);
  EXPECT_EQ(out.get(20), 0.0f) << "the other eye looks ahead";
}

TEST(Mixer, HostileInputStaysFiniteAndWithinTheLimits) {
  FapLimits limits;
  limits.low.fill(-100.0f);
  limits.high.fill(200.0f);
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(), 3e38f, -3e38f};
  for (const float value : bad) {
    FapFrame frame;
    for (int fap = 3; fap <= kFapCount; ++fap) frame.set(fap, value);
    const FapFrame out = MixJob{.rest = &frame,
                                .emotion = &frame,
                                .speech = &frame,
                                .speech_strength = value,
                                .stream = nullptr,
                                .idle = &frame,
                                .limits = &limits}
                             .run();
    for (int fap = 3; fap <= kFapCount; ++fap) {
      EXPECT_TRUE(std::isfinite(out.get(fap))) << fap;
      EXPECT_LE(std::abs(out.get(fap)), 4e3f) << fap;
    }
  }
}

TEST(Lips, SealMovesBothToWhereTheyMeet) {
  FapFrame frame;
  frame.set(4, 100.0f);
  frame.set(5, 50.0f);
  seal_lips(frame);
  EXPECT_FLOAT_EQ(frame.get(4), 25.0f);
  EXPECT_FLOAT_EQ(frame.get(5), -25.0f);
}

TEST(Lips, SealLeavesPartedLipsAlone) {
  FapFrame frame;
  frame.set(4, -100.0f);
  frame.set(5, 50.0f);
  seal_lips(frame);
  EXPECT_EQ(frame.get(4), -100.0f);
  EXPECT_EQ(frame.get(5), 50.0f);
}

TEST(Flesh, ASinglePointTakesItsNeighboursAlong) {
  FapFrame frame;
  frame.set(5, -900.0f);
  keep_flesh_whole(frame);
  EXPECT_EQ(frame.get(5), -900.0f);
  EXPECT_EQ(frame.get(52), -820.0f);
  EXPECT_EQ(frame.get(10), -720.0f);
  EXPECT_EQ(frame.get(4), 0.0f) << "the other lip stays";
}

TEST(Lips, AWideJawPartsThemAndASmallOneDoesNot) {
  FapFrame frame;
  frame.set(3, 500.0f);
  part_lips(frame);
  EXPECT_EQ(frame.get(5), 0.0f);
  frame.set(3, 1000.0f);
  part_lips(frame);
  EXPECT_EQ(frame.get(5), -400.0f);
  frame.set(5, -700.0f);
  part_lips(frame);
  EXPECT_EQ(frame.get(5), -700.0f);
}

TEST(Tongue, StaysBehindShutTeethAndComesOutBetweenOpenOnes) {
  FapFrame frame;
  frame.set(45, 400.0f);
  keep_tongue_in(frame);
  const float shut = frame.get(45);
  EXPECT_LT(shut, 30.0f);
  frame.set(45, 400.0f);
  frame.set(3, 300.0f);
  keep_tongue_in(frame);
  EXPECT_EQ(frame.get(45), shut) << "the lips are still shut";
  frame.set(45, 200.0f);
  frame.set(5, -300.0f);
  keep_tongue_in(frame);
  EXPECT_EQ(frame.get(45), 200.0f);
}

TEST(Mixer, ABlinkMovesTheUpperLid) {
  const FapLimits limits = wide();
  FapFrame idle;
  for (const float closure : {0.25f, 0.5f, 0.75f, 1.0f}) {
    idle.set(19, closure * 1024.0f);
    const FapFrame out = MixJob{.idle = &idle, .limits = &limits}.run();
    EXPECT_LT(out.get(21), 0.1f * 1024.0f);
    EXPECT_NEAR(out.get(19) + out.get(21), closure * 1024.0f, 30.0f);
  }
}

TEST(Flesh, WholeFacesPassUnchanged) {
  for (std::size_t e = 1; e < 15; ++e) {
    const FapFrame viseme = viseme_frame(static_cast<int>(e));
    FapFrame kept = viseme;
    keep_flesh_whole(kept);
    EXPECT_EQ(kept.value, viseme.value) << e;
  }
}

TEST(Soften, IsExactWithinTheWorkingRangeAndNeverPassesTheLimit) {
  EXPECT_EQ(soften(99.0f, -115.0f, 115.0f), 99.0f);
  EXPECT_EQ(soften(-99.0f, -115.0f, 115.0f), -99.0f);
  float last = soften(100.0f, 0.0f, 115.0f);
  for (float v = 101.0f; v < 1000.0f; v += 7.0f) {
    const float s = soften(v, 0.0f, 115.0f);
    EXPECT_GT(s, last);
    EXPECT_LT(s, 115.0f);
    last = s;
  }
  EXPECT_EQ(soften(-50.0f, 0.0f, 115.0f), 0.0f);
}

TEST(Visemes, BlendFollowsTheRuleOfFap1) {
  const FapFrame a = viseme_frame(10), b = viseme_frame(14);
  const FapFrame mixed = blend_visemes({10, 14, 21, false});
  EXPECT_NEAR(mixed.get(3), a.get(3) / 3.0f + b.get(3) * 2.0f / 3.0f, 1e-3f);
  EXPECT_EQ(blend_visemes({10, 14, 63, false}).get(3), a.get(3));
  EXPECT_EQ(blend_visemes({10, 14, 0, false}).get(3), b.get(3));
  EXPECT_FALSE(blend_visemes({0, 0, 63, false}).mask.any());
}

TEST(Visemes, LowLevelFapsWinOverTheViseme) {
  FapFrame frame;
  frame.mask.set(kFapViseme);
  frame.viseme = {10, 0, 63, false};
  frame.set(3, 5.0f);
  expand_viseme(frame);
  EXPECT_EQ(frame.get(3), 5.0f);
  EXPECT_EQ(frame.get(5), viseme_frame(10).get(5));
  EXPECT_FALSE(frame.has(kFapViseme));
}

}  // namespace
}  // namespace caryatid::face
