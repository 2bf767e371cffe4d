// Phonemes become visemes by how they are articulated.
#include "core/speech/sound.h"

#include <gtest/gtest.h>

#include <string_view>

namespace caryatid::speech {
namespace {

Phoneme of(std::string_view ipa) { return phoneme_of(ipa); }
int main_viseme(const Sound& s) { return s.blend >= 32 ? s.first : s.second; }

TEST(Sound, ConsonantsFollowTheStandardsExamples) {
  // ISO/IEC 14496-2 annex C: put bed mill; far voice; think that; tip doll; call gas; chair join
  // she; sir zeal; lot not; red.
  const struct {
    const char* ipa;
    int viseme;
  } cases[] = {{"p", 1}, {"b", 1}, {"m", 1}, {"f", 2}, {"v", 2}, {"θ", 3},  {"ð", 3},
               {"t", 4}, {"d", 4}, {"k", 5}, {"ɡ", 5}, {"g", 5}, {"tʃ", 6}, {"dʒ", 6},
               {"ʃ", 6}, {"s", 7}, {"z", 7}, {"l", 8}, {"n", 8}, {"ɹ", 9}};
  for (const auto& c : cases) EXPECT_EQ(main_viseme(of(c.ipa).begins), c.viseme) << c.ipa;
}

TEST(Sound, VowelsFollowTheStandardsExamples) {
  // Car, bed, tip, top, book.
  EXPECT_EQ(main_viseme(of("ɑː").begins), 10);
  EXPECT_EQ(main_viseme(of("ɛ").begins), 11);
  EXPECT_EQ(main_viseme(of("ɪ").begins), 12);
  EXPECT_EQ(main_viseme(of("ɒ").begins), 13);
  EXPECT_EQ(main_viseme(of("ʊ").begins), 14);
}

TEST(Sound, GreekVowelsAreTheFivePlainOnes) {
  EXPECT_EQ(main_viseme(of("a").begins), 10);
  EXPECT_EQ(main_viseme(of("e").begins), 11);
  EXPECT_EQ(main_viseme(of("i").begins), 12);
  EXPECT_EQ(main_viseme(of("o").begins), 13);
  EXPECT_EQ(main_viseme(of("u").begins), 14);
}

TEST(Sound, ContactsAreThoseOfPlaceAndManner) {
  for (const char* ipa : {"p", "b", "m", "ɓ"}) EXPECT_EQ(of(ipa).begins.contact, Contact::lips);
  for (const char* ipa : {"f", "v", "ɱ"}) EXPECT_EQ(of(ipa).begins.contact, Contact::lip_teeth);
  for (const char* ipa : {"θ", "ð"}) EXPECT_EQ(of(ipa).begins.contact, Contact::tongue_teeth);
  for (const char* ipa : {"t", "n", "l", "ɾ", "ɲ"})
    EXPECT_EQ(of(ipa).begins.contact, Contact::tongue_palate);
  for (const char* ipa : {"a", "k", "ʃ", "w", "β", "ʋ"})
    EXPECT_EQ(of(ipa).begins.contact, Contact::none) << ipa;
}

TEST(Sound, RoundingIsSeenInFrontVowelsToo) {
  EXPECT_EQ(main_viseme(of("y").begins), 14);  // German ü, Turkish ü.
  EXPECT_EQ(main_viseme(of("i").begins), 12);
}

TEST(Sound, DiphthongsHaveTwoSounds) {
  const Phoneme p = of("aɪ");
  EXPECT_EQ(main_viseme(p.begins), 10);
  EXPECT_EQ(main_viseme(p.ends), 12);
}

TEST(Sound, SyllabicConsonantsKeepTheirContact) {
  const Phoneme p = of("əl");
  EXPECT_TRUE(p.begins.vowel);
  EXPECT_EQ(p.ends.contact, Contact::tongue_palate);
}

TEST(Sound, StressAndLengthAreNoSounds) {
  const Phoneme p = of("ˈiː");
  EXPECT_TRUE(p.stressed);
  EXPECT_EQ(p.begins, p.ends);
  EXPECT_EQ(p.begins, of("i").begins);
  EXPECT_FALSE(of("ˌiː").stressed);
}

TEST(Sound, SoftnessColoursNothingButItself) {
  EXPECT_EQ(of("mʲ").begins, of("m").begins);
  EXPECT_EQ(main_viseme(of("ʲ").begins), 12);
}

TEST(Sound, NothingIsSilence) {
  EXPECT_TRUE(of("").begins.silent());
  EXPECT_TRUE(of("_").begins.silent());
  EXPECT_TRUE(of("ˈ").begins.silent());
}

TEST(Sound, WhatIsUnknownIsWeakNotSilent) {
  for (const char* ipa : {"\xFF\xFE", "ǃ", "☃"}) {
    EXPECT_FALSE(of(ipa).begins.silent()) << ipa;
    EXPECT_LE(of(ipa).begins.hold, 0.25f) << ipa;
  }
}

TEST(Sound, TruncatedUtf8IsUnknown) {
  const std::string_view theta = "θ";
  EXPECT_LE(of(theta.substr(0, 1)).begins.hold, 0.25f);
}

}  // namespace
}  // namespace caryatid::speech
