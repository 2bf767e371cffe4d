#include "core/speech/utterance.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>

#include "core/speech/text.h"

namespace caryatid::speech {
namespace {

Phoneme of(std::string_view ipa) { return phoneme_of(ipa); }

TEST(Utterance, AWordLastsUntilTheNextOneOrAPause) {
  auto u = std::make_unique<Utterance>();
  u->add_word(0, 0, 5);
  (void)u->add_phone(0, of("a"));
  u->add_word(300, 6, 9);
  (void)u->add_phone(300, of("b"));
  (void)u->add_phone(400, of(""));
  u->add_word(900, 10, 12);
  u->finish(1200);
  ASSERT_EQ(u->words().size(), 3u);
  EXPECT_EQ(u->words()[0].end_ms, 300);
  EXPECT_EQ(u->words()[1].end_ms, 400);
  EXPECT_EQ(u->words()[2].end_ms, 1200);
}

TEST(Utterance, AStressMarkStressesItsWord) {
  auto u = std::make_unique<Utterance>();
  u->add_word(0, 0, 2);
  (void)u->add_phone(0, of("ə"));
  u->add_word(100, 3, 9);
  (void)u->add_phone(100, of("m"));
  (void)u->add_phone(160, of("ˈa"));
  EXPECT_FALSE(u->words()[0].stressed());
  EXPECT_EQ(u->words()[1].stress_ms, 160);
}

TEST(Utterance, WordAtGivesTheOneThatIsHeard) {
  auto u = std::make_unique<Utterance>();
  u->add_word(100, 0, 2);
  u->add_word(300, 3, 5);
  EXPECT_EQ(u->word_at(50), -1);
  EXPECT_EQ(u->word_at(100), 0);
  EXPECT_EQ(u->word_at(299), 0);
  EXPECT_EQ(u->word_at(5000), 1);
}

TEST(Utterance, TimesNeverFall) {
  auto u = std::make_unique<Utterance>();
  (void)u->add_phone(500, of("a"));
  (void)u->add_phone(100, of("e"));
  (void)u->add_phone(-5, of("i"));
  EXPECT_EQ(u->phones()[1].start_ms, 500);
  EXPECT_EQ(u->phones()[2].start_ms, 500);
}

TEST(Utterance, HeardPhonesMakeRoomForLaterOnes) {
  auto u = std::make_unique<Utterance>();
  for (std::size_t i = 0; i < kMaxPhones; ++i)
    ASSERT_TRUE(u->add_phone(static_cast<std::int32_t>(i) * 50, of("a")).ok());
  EXPECT_EQ(u->add_phone(1'000'000, of("a")).code, Code::out_of_capacity);
  u->forget_before(50 * 100);
  EXPECT_EQ(u->phones().front().start_ms, 50 * 100);
  EXPECT_TRUE(u->add_phone(1'000'000, of("a")).ok());
}

TEST(Utterance, WordsBeyondTheCapacityAreCounted) {
  auto u = std::make_unique<Utterance>();
  for (std::uint32_t i = 0; i < kMaxWords + 3; ++i)
    u->add_word(static_cast<std::int32_t>(i), 2 * i, 2 * i + 1);
  EXPECT_EQ(u->words().size(), kMaxWords);
  EXPECT_EQ(u->dropped(), 3u);
}

TEST(Utterance, AnotherVoiceGoesOnWhereTheFirstFellSilent) {
  auto u = std::make_unique<Utterance>();
  u->add_word(0, 0, 5);
  u->continue_at(2000, 40);
  u->add_word(100, 0, 3);
  u->finish(900);
  EXPECT_EQ(u->words()[0].end_ms, 2000);
  EXPECT_EQ(u->words()[1].begin_byte, 40u);
  EXPECT_EQ(u->words()[1].start_ms, 2100);
  EXPECT_EQ(u->end_ms(), 2900);
}

std::string mend(std::string_view text, std::size_t room = 100, bool* cut = nullptr) {
  std::string out(room, '\0');
  bool was_cut = false;
  out.resize(mend_text(text, out, &was_cut));
  if (cut != nullptr) *cut = was_cut;
  return out;
}

TEST(Text, ValidTextStaysAsItIs) {
  EXPECT_EQ(mend("Καλώς ήρθατε, 你好 🎉"), "Καλώς ήρθατε, 你好 🎉");
}

TEST(Text, InvalidBytesBecomeReplacements) {
  EXPECT_EQ(mend("a\xFF\x80z"), "a\uFFFD\uFFFDz");
  EXPECT_EQ(mend("\xC0\xAF"), "\uFFFD\uFFFD");            // Overlong.
  EXPECT_EQ(mend("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");  // Half of a surrogate pair.
  EXPECT_EQ(mend("x\xCE"), "x\uFFFD");                    // Torn off.
}

TEST(Text, ControlCharactersAreBlanks) { EXPECT_EQ(mend(std::string_view("a\0b\x1B", 4)), "a b "); }

TEST(Text, WhatIsTooLongIsCutAfterAWord) {
  bool cut = false;
  EXPECT_EQ(mend("one two three", 9, &cut), "one two");
  EXPECT_TRUE(cut);
  EXPECT_EQ(mend("one two three", 13, &cut), "one two three");
  EXPECT_FALSE(cut);
}

TEST(Text, AMegabyteIsCut) {
  std::string long_text;
  while (long_text.size() < 1'000'000) long_text += "λέξη ";
  bool cut = false;
  const std::string out = mend(long_text, kMaxSpeechBytes, &cut);
  EXPECT_TRUE(cut);
  EXPECT_LE(out.size(), kMaxSpeechBytes);
  EXPECT_EQ(mend(out, out.size()), out);  // Still valid.
}

TEST(Text, ARecordingIsNamedByItsTextAndLanguage) {
  const auto name = [](std::string_view text, std::string_view language) {
    return std::string(recording_name(text, language).c_str());
  };
  EXPECT_EQ(name("a", "en"), "af63dc4c8601ec8c-en");  // FNV-1a of "a".
  EXPECT_NE(name("a", "en"), name("b", "en"));
  EXPECT_EQ(name("a", "../x"), "af63dc4c8601ec8c-___x");  // Never leaves its folder.
}

TEST(Text, SentencesEndBeforeABlank) {
  const std::string_view text = "It costs 3.50 euro. Really? Yes.";
  EXPECT_EQ(next_sentence(text, 0), 20u);
  EXPECT_EQ(next_sentence(text, 20), 28u);
  EXPECT_EQ(next_sentence(text, 28), text.size());
}

TEST(Text, SentencesOfSsmlEndBeforeTagsToo) {
  const std::string_view text = "<s>One<break time=\"0.5s\"/> two.</s><s>Three.</s>";
  const std::uint32_t next = next_sentence(text, 3, true);
  EXPECT_EQ(text.substr(next, 7), "</s><s>");
}

TEST(Text, TagsAreNoWords) {
  const std::string_view text = "<speak>Hello <b x=\"1\"/>you</speak>";
  const auto first = next_word(text, 0, true);
  ASSERT_TRUE(first);
  EXPECT_EQ(text.substr(first->begin, first->end - first->begin), "Hello");
  const auto second = next_word(text, first->end, true);
  ASSERT_TRUE(second);
  EXPECT_EQ(text.substr(second->begin, second->end - second->begin), "you");
  EXPECT_FALSE(next_word(text, second->end, true));
}

TEST(Text, SilentWordsPassAtAReadersPace) {
  auto u = std::make_unique<Utterance>();
  const std::string_view text = "Good morning everybody.";
  pace_words(text, 0, 1000, false, u.get());
  ASSERT_EQ(u->words().size(), 3u);
  EXPECT_EQ(u->words()[0].start_ms, 1000);
  EXPECT_EQ(u->words()[2].begin_byte, 13u);
  EXPECT_TRUE(u->finished());
  const double characters_a_second =
      static_cast<double>(text.size()) / ((u->end_ms() - 1000) * 1e-3);
  EXPECT_GT(characters_a_second, 8.0);
  EXPECT_LT(characters_a_second, 17.0);
}

}  // namespace
}  // namespace caryatid::speech
