// How feelings sound, by Schroeder's rules.
#include "core/speech/prosody.h"

#include <gtest/gtest.h>

namespace caryatid::speech {
namespace {

TEST(Prosody, CalmChangesNothing) {
  const Prosody p = prosody_at(0.0f, 0.0f);
  EXPECT_EQ(p.rate, 1.0f);
  EXPECT_EQ(p.pitch, 1.0f);
  EXPECT_EQ(p.range, 1.0f);
}

TEST(Prosody, ActivationIsFastHighAndLively) {
  Prosody before = prosody_at(-1.0f, 0.0f);
  for (float a = -0.8f; a <= 1.0f; a += 0.2f) {
    const Prosody p = prosody_at(a, 0.0f);
    EXPECT_GT(p.rate, before.rate);
    EXPECT_GT(p.pitch, before.pitch);
    EXPECT_GT(p.range, before.range);
    before = p;
  }
}

TEST(Prosody, StaysWithinWhatAVoiceTakesAndAListenerFollows) {
  for (float a = -1.0f; a <= 1.0f; a += 0.5f)
    for (float e = -1.0f; e <= 1.0f; e += 0.5f) {
      const Prosody p = prosody_at(a, e);
      EXPECT_GE(p.rate, 0.6f);
      EXPECT_LE(p.rate, 1.4f);
      EXPECT_GE(p.pitch, 0.5f);
      EXPECT_LE(p.pitch, 1.5f);
      EXPECT_GE(p.range, 0.0f);
      EXPECT_LE(p.range, 2.0f);
    }
}

}  // namespace
}  // namespace caryatid::speech
