#include "core/speech/liveliness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace caryatid::speech {
namespace {

// Ten words of 300 ms, each second one stressed; a pause of 400 ms after the fifth.
std::unique_ptr<Utterance> sentence() {
  auto u = std::make_unique<Utterance>();
  std::int32_t t = 100;
  u->add_sentence(t);
  for (std::uint32_t w = 0; w < 10; ++w) {
    u->add_word(t, 5 * w, 5 * w + 4);
    (void)u->add_phone(t, phoneme_of(std::string_view("m")));
    (void)u->add_phone(t + 80, phoneme_of(std::string_view(w % 2 == 1 ? "ˈa" : "a")));
    t += 300;
    if (w != 4) continue;
    (void)u->add_phone(t, Phoneme{});
    t += 400;
    u->add_sentence(t);
  }
  (void)u->add_phone(t, Phoneme{});
  u->finish(t + 300);
  return u;
}

struct Seen {
  float brow = 0.0f, nod = 0.0f, breath_before_second = 0.0f;
  int blinks = 0, beats = 0;
  float last_brow = 0.0f;
};

Seen play(const Utterance& u, float amount, std::uint64_t seed) {
  Liveliness life(seed);
  life.begin(amount);
  Seen seen;
  for (int frame = 0; frame < 240; ++frame) {
    const float now = static_cast<float>(frame) * 1000.0f / 30.0f;
    const bool speaking = now < static_cast<float>(u.end_ms());
    const Life& l = life.step(u, now, 1.0f / 30.0f, speaking);
    seen.brow = std::max(seen.brow, l.faps.get(31));
    seen.nod = std::max(seen.nod, l.faps.get(48));
    seen.blinks += l.blink;
    seen.beats += l.beat > 0.0f;
    if (now > 1750.0f && now < 1990.0f)
      seen.breath_before_second = std::max(seen.breath_before_second, l.breath);
    seen.last_brow = l.faps.get(31);
  }
  return seen;
}

TEST(Liveliness, StressMovesBrowsAndHead) {
  const Seen seen = play(*sentence(), 1.0f, 1);
  EXPECT_GT(seen.brow, 15.0f);
  EXPECT_LT(seen.brow, 120.0f);
  EXPECT_GT(seen.nod, 500.0f);   // Half a degree.
  EXPECT_LT(seen.nod, 7000.0f);  // Four.
  EXPECT_GE(seen.beats, 1);
}

TEST(Liveliness, BlinksAtThePauseMoreOftenThanNot) {
  int blinks = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    blinks += play(*sentence(), 1.0f, seed).blinks > 0;
  EXPECT_GE(blinks, 12);
}

TEST(Liveliness, BreathesBeforeASentence) {
  EXPECT_GT(play(*sentence(), 1.0f, 1).breath_before_second, 0.5f);
}

TEST(Liveliness, ComesToRest) { EXPECT_LT(play(*sentence(), 1.0f, 1).last_brow, 1.0f); }

TEST(Liveliness, NoneOfItWhenTheDeployerWantsNone) {
  const Seen seen = play(*sentence(), 0.0f, 1);
  EXPECT_FLOAT_EQ(seen.brow, 0.0f);
  EXPECT_EQ(seen.beats, 0);
}

TEST(Liveliness, SameSeedSameLife) {
  const auto u = sentence();
  Liveliness a(7), b(7);
  a.begin(1.0f);
  b.begin(1.0f);
  for (int frame = 0; frame < 100; ++frame) {
    const float now = static_cast<float>(frame) * 33.0f;
    const Life& la = a.step(*u, now, 0.033f, true);
    const Life& lb = b.step(*u, now, 0.033f, true);
    EXPECT_EQ(la.faps.value, lb.faps.value);
    EXPECT_EQ(la.blink, lb.blink);
  }
}

}  // namespace
}  // namespace caryatid::speech
