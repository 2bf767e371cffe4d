// The measure of lip sync itself: a mouth that is shifted on purpose is found to be.
#include "assets/bake/speech/sync.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/base/random.h"
#include "core/speech/mouth.h"

namespace caryatid::bake {
namespace {

struct Take {
  std::vector<TimedPhone> phones;
  std::vector<MouthFrame> frames;
};

// A minute of phones; the mouth is late by `late_s` and slower than the sound by `drift`.
Take take(double late_s, double drift = 0.0) {
  constexpr const char* kSounds[] = {"m", "ɑː", "s", "iː", "p", "ʊ", "f", "ɛ", "t", "ɔː"};
  Take out;
  auto u = std::make_unique<speech::Utterance>();
  Random random(5);
  double t = 0.5;
  while (out.phones.size() < 500) {
    out.phones.push_back({t, kSounds[out.phones.size() % std::size(kSounds)]});
    (void)u->add_phone(static_cast<std::int32_t>(t * 1000.0),
                       speech::phoneme_of(out.phones.back().ipa));
    t += 0.08 + 0.06 * double{random.unit()};
  }
  u->finish(static_cast<std::int32_t>(t * 1000.0));
  const speech::Mouth mouth;
  for (int f = 0; f < static_cast<int>(t * 30.0); ++f) {
    const double time_s = f / 30.0;
    const double heard_ms = (time_s - late_s - drift * time_s) * 1000.0;
    const face::FapFrame faps = mouth.at(*u, static_cast<float>(heard_ms), 33.3f).faps;
    out.frames.push_back(
        {time_s, faps.get(3), faps.get(4), faps.get(5), faps.get(6), faps.get(16), faps.get(17)});
  }
  return out;
}

double median(double late_s) {
  const Take t = take(late_s);
  return percentile(measure_sync(t.frames, t.phones).late_s, 50);
}

TEST(Sync, SeesAMouthThatIsLate) {
  const double own = median(0.0);
  EXPECT_NEAR(median(0.05) - own, 0.05, 0.006);
  EXPECT_NEAR(median(-0.05) - own, -0.05, 0.006);
}

TEST(Sync, SeesDrift) {
  const Take still = take(0.0), drifting = take(0.0, 0.001);
  EXPECT_NEAR(drift_s_per_s(measure_sync(still.frames, still.phones)), 0.0, 1e-4);
  EXPECT_NEAR(drift_s_per_s(measure_sync(drifting.frames, drifting.phones)), 0.001, 2e-4);
}

TEST(Sync, TheMouthOfThisProjectIsInStep) {
  const Take t = take(0.0);
  const SyncReport r = measure_sync(t.frames, t.phones);
  EXPECT_GT(r.late_s.size(), 490u);
  EXPECT_GE(share_within(r.late_s, -0.045, 0.015), 0.99);
  EXPECT_GE(share_within(r.contact_late_s, -0.045, 0.015), 0.99);
  EXPECT_EQ(r.shut, r.bilabials);
  EXPECT_GT(r.bilabials, 90u);
  EXPECT_EQ(r.touching, r.labiodentals);
}

TEST(Sync, AMouthThatStaysOpenIsSeen) {
  Take t = take(0.0);
  for (MouthFrame& f : t.frames) f.lower_lip -= 200.0f;
  EXPECT_EQ(measure_sync(t.frames, t.phones).shut, 0u);
}

TEST(Sync, FindsASoundInAFile) {
  Random random(9);
  std::vector<std::int16_t> whole(20000);
  for (auto& s : whole) s = static_cast<std::int16_t>(random.between(-9000.0f, 9000.0f));
  const std::span part = std::span(whole).subspan(12345, 800);
  EXPECT_EQ(find_sound(whole, part, 12000, 1000), 12345);
  EXPECT_EQ(find_sound(whole, part, 2000, 1000), -1);
}

}  // namespace
}  // namespace caryatid::bake
