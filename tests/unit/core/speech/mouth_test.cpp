// The mouth in motion: what must touch touches, whatever stands beside it and however fast.
#include "core/speech/mouth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/face/mixer.h"
#include "tests/unit/core/speech/spoken.h"

namespace caryatid::speech {
namespace {

const Mouth& mouth() {
  static const Mouth m;
  return m;
}

// The gap between the inner lips in MNS/1024, middle and quarter points: the largest.
float lip_gap(const face::FapFrame& f) {
  return std::max({-(f.get(4) + f.get(5)), -(f.get(8) + f.get(10)), -(f.get(9) + f.get(11))});
}

// Pictures at `fps` with any phase: the least of `measure` among those in which the sound from
// `from_ms` on, `length_ms` long, is the one that shows.
template <class Measure>
float least_seen(const Utterance& u, float from_ms, float length_ms, float fps, float phase,
                 Measure measure) {
  const float frame = 1000.0f / fps;
  float least = 1e9f;
  for (float t = phase * frame; t < from_ms + length_ms + 100.0f; t += frame) {
    // A contact may lead its sound by 45 ms and lag by 15 and still be in step with it.
    if (t + frame < from_ms - 45.0f || t > from_ms + std::max(length_ms, frame) + 15.0f) continue;
    least = std::min(least, measure(mouth().at(u, t, frame).faps));
  }
  return least;
}

TEST(Mouth, LipsShutOnEveryBilabialBetweenAllVowels) {
  for (const char* consonant : {"p", "b", "m"})
    for (const char* vowel : {"a", "i", "u", "ɔ", "æ", "ə", "y"})
      for (const float length : {30.0f, 45.0f, 80.0f, 140.0f})
        for (const float phase : {0.0f, 0.25f, 0.5f, 0.75f})
          for (const float fps : {15.0f, 25.0f, 30.0f, 60.0f}) {
            const auto u = spoken({vowel, consonant, vowel}, static_cast<std::int32_t>(length));
            const float start = 200.0f + length;
            EXPECT_LE(least_seen(*u, start, length, fps, phase, lip_gap), 0.0f)
                << vowel << consonant << vowel << " " << length << " ms at " << fps;
          }
}

TEST(Mouth, LowerLipMeetsTheTeethOnEveryLabiodental) {
  const face::FapFrame target = face::viseme_frame(2);
  const auto away = [&target](const face::FapFrame& f) {
    float most = 0.0f;
    for (const int fap : {4, 5, 8, 9, 10, 11, 16})
      most = std::max(most, std::abs(f.get(fap) - target.get(fap)));
    return most;
  };
  for (const char* consonant : {"f", "v"})
    for (const char* vowel : {"a", "i", "u", "ɔ"})
      for (const float length : {40.0f, 80.0f})
        for (const float phase : {0.0f, 0.5f}) {
          const auto u = spoken({vowel, consonant, vowel}, static_cast<std::int32_t>(length));
          EXPECT_LE(least_seen(*u, 200.0f + length, length, 30.0f, phase, away), 1.0f);
        }
}

TEST(Mouth, TongueIsSeenOnThAndL) {
  for (const char* consonant : {"θ", "ð", "l"}) {
    const auto u = spoken({"u", consonant, "u"}, 80);
    const int viseme = consonant[0] == 'l' ? 8 : 3;
    const MouthShape m = mouth().at(*u, 200.0f + 110.0f - mouth_lead_ms(33.0f), 33.0f);
    for (int fap = 43; fap <= 47; ++fap)
      EXPECT_NEAR(m.faps.get(fap), face::viseme_frame(viseme).get(fap), 1.0f) << consonant;
    EXPECT_GT(lip_gap(m.faps), 100.0f) << consonant;
  }
}

// The same questions to a mouth that only blends: they are not answered by chance.
TEST(Mouth, ABlendAloneHasNoContacts) {
  const Mouth blend(false);
  const float t = 200.0f + 45.0f - mouth_lead_ms(33.0f);
  const auto at = [&](const char* consonant) {
    return blend.at(*spoken({"ɑː", consonant, "ɑː"}, 30), t, 33.0f).faps;
  };
  EXPECT_GT(lip_gap(at("p")), 20.0f);
  EXPECT_GT(lip_gap(at("m")), 20.0f);
  const auto off = [](const face::FapFrame& shown, int viseme, std::initializer_list<int> faps) {
    float most = 0.0f;
    for (const int fap : faps)
      most = std::max(most, std::abs(shown.get(fap) - face::viseme_frame(viseme).get(fap)));
    return most;
  };
  EXPECT_GT(off(at("f"), 2, {4, 5, 16, 17}), 20.0f);
  EXPECT_GT(off(at("θ"), 3, {43, 44, 45, 46, 47}), 5.0f);
  EXPECT_GT(off(at("l"), 8, {43, 44, 45, 46, 47}), 5.0f);
}

TEST(Mouth, NeighboursColourASound) {
  // Lips are rounded already in the k before u, not in that before i.
  const auto rounded = spoken({"k", "u"}, 90), spread = spoken({"k", "i"}, 90);
  const float t = 200.0f + 45.0f - mouth_lead_ms(33.0f);
  EXPECT_LT(mouth().at(*rounded, t, 33.0f).faps.get(6), mouth().at(*spread, t, 33.0f).faps.get(6));
}

TEST(Mouth, HasteKeepsTheMouthSmaller) {
  const auto slow = spoken({"t", "a", "t"}, 160), fast = spoken({"t", "a", "t"}, 50);
  const auto widest = [](const Utterance& u) {
    float most = 0.0f;
    for (float t = 0.0f; t < 900.0f; t += 5.0f)
      most = std::max(most, mouth().at(u, t, 33.0f).faps.get(3));
    return most;
  };
  EXPECT_LT(widest(*fast), 0.9f * widest(*slow));
}

TEST(Mouth, StressOpensIt) {
  const auto plain = spoken({"t", "a", "t"}, 120), stressed = spoken({"t", "ˈa", "t"}, 120);
  const float t = 200.0f + 180.0f - mouth_lead_ms(33.0f);
  EXPECT_GT(mouth().at(*stressed, t, 33.0f).faps.get(3), mouth().at(*plain, t, 33.0f).faps.get(3));
}

TEST(Mouth, ShutsInPausesAndAtTheEnd) {
  auto u = std::make_unique<Utterance>();
  (void)u->add_phone(0, phoneme_of(std::string_view("a")));
  (void)u->add_phone(200, Phoneme{});
  (void)u->add_phone(500, phoneme_of(std::string_view("a")));
  (void)u->add_phone(700, Phoneme{});
  u->finish(1000);
  const MouthShape pause = mouth().at(*u, 350.0f, 33.0f);
  EXPECT_LT(lip_gap(pause.faps), 15.0f);
  EXPECT_FLOAT_EQ(pause.strength, 1.0f);  // The mood waits.
  EXPECT_FLOAT_EQ(mouth().at(*u, 1200.0f, 33.0f).strength, 0.0f);
}

TEST(Mouth, MovesSmoothly) {
  const auto u = spoken({"m", "ɑː", "f", "i", "p", "u", "θ", "æ", "s", "ɔː", "m", "b"}, 70);
  face::FapFrame before = mouth().at(*u, 0.0f, 33.0f).faps;
  for (float t = 2.0f; t < 1400.0f; t += 2.0f) {
    const face::FapFrame now = mouth().at(*u, t, 33.0f).faps;
    // A jaw of 640/1024 MNS in 60 ms at its fastest is 21 in 2 ms; lips may be twice as fast.
    for (const int fap : {3, 4, 5, 6, 16, 17})
      EXPECT_LT(std::abs(now.get(fap) - before.get(fap)), 60.0f) << fap << " at " << t;
    before = now;
  }
}

TEST(Mouth, LipsStayShutUnderEveryLimitOfAFace) {
  face::FapLimits limits;
  limits.low.fill(-900.0f);
  limits.high.fill(900.0f);
  face::FapFrame smile;
  for (const int fap : {6, 7, 12, 13, 53, 54, 59, 60}) smile.set(fap, 250.0f);
  for (const int fap : {3, 4, 5, 8, 9, 10, 11}) smile.set(fap, fap == 3 ? 300.0f : -150.0f);
  const auto u = spoken({"a", "p", "a"}, 80);
  const MouthShape m = mouth().at(*u, 200.0f + 110.0f - mouth_lead_ms(33.0f), 33.0f);
  const face::FapFrame shown =
      face::MixJob{
          .emotion = &smile, .speech = &m.faps, .speech_strength = m.strength, .limits = &limits}
          .run();
  EXPECT_LE(lip_gap(shown), 0.0f);
  EXPECT_GT(shown.get(6), 60.0f);  // And the smile stays in the corners.
}

TEST(Mouth, Fap1NamesTheSoundThatShows) {
  const auto u = spoken({"s", "m", "ɑː"}, 120);
  EXPECT_EQ(mouth().at(*u, 200.0f + 60.0f - mouth_lead_ms(33.0f), 33.0f).viseme.first, 7);
  EXPECT_EQ(mouth().at(*u, 200.0f + 180.0f - mouth_lead_ms(33.0f), 33.0f).viseme.first, 1);
  EXPECT_EQ(mouth().at(*u, 200.0f + 300.0f - mouth_lead_ms(33.0f), 33.0f).viseme.first, 10);
}

TEST(Mouth, AnEmptyUtteranceShowsNothing) {
  const Utterance u;
  const MouthShape m = mouth().at(u, 0.0f, 33.0f);
  EXPECT_FLOAT_EQ(m.strength, 0.0f);
  EXPECT_FLOAT_EQ(m.faps.get(3), 0.0f);
}

}  // namespace
}  // namespace caryatid::speech
