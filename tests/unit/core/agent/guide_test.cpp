// The guide on a programme of three pages, two languages and four buttons, written by hand.
#include "core/agent/guide.h"

#include <gtest/gtest.h>

#include "tests/unit/core/agent/small_programme.h"

namespace caryatid::agent {
namespace {

class GuideTest : public testing::Test {
 protected:
  void SetUp() override { guide_.take(small_.programme()); }
  const Guidance& press(std::uint16_t button) {
    const ButtonEvent event{button, true, 0};
    return guide_.step(0.03f, {&event, 1}, noon_, false);
  }
  const Guidance& wait(float seconds, bool speaking = false) {
    for (float t = 0.0f; t < seconds; t += 0.25f) {
      const Guidance& g = guide_.step(0.25f, {}, noon_, speaking);
      signs_ += g.says ? 1 : 0;
    }
    return guide_.guidance();
  }
  SmallProgramme small_;
  Guide guide_;
  Moment noon_{2, 25, 11, 12 * 60};
  int signs_ = 0;
};

TEST_F(GuideTest, AButtonLeadsToItsPageInTheSameStep) {
  const Guidance& g = press(SmallProgramme::kGoMaps);
  EXPECT_TRUE(g.pressed);
  EXPECT_TRUE(g.visited);
  EXPECT_EQ(g.page, SmallProgramme::kMaps);
  EXPECT_TRUE(g.says);
  EXPECT_EQ(g.picture, 0);
  EXPECT_TRUE(g.feels);
  EXPECT_EQ(g.feel, emotion::Emotion::surprise);
  EXPECT_FALSE(guide_.step(0.03f, {}, noon_, true).says);  // Once.
}

TEST_F(GuideTest, ANoticeIsShownToNobodyTooAndAtNight) {
  EXPECT_FALSE(wait(60.0f).visited);
  std::vector<std::uint32_t> words = small_.words();
  constexpr std::uint16_t kYes = 1;
  std::memcpy(reinterpret_cast<std::byte*>(words.data()) + offsetof(ProgrammeHeader, always_shown),
              &kYes, sizeof kYes);
  SmallProgramme::seal(&words);
  Guide notice;
  notice.take(read_programme(std::as_bytes(std::span(words)), 0, 10).value);
  const Moment night{2, 25, 11, 23 * 60};
  EXPECT_TRUE(notice.step(0.03f, {}, night, false).visited);
  EXPECT_FALSE(notice.guidance().asleep);
}

TEST_F(GuideTest, ThePageComesBeforeTheButtonsOwnAction) {
  press(SmallProgramme::kGoMaps);
  const Guidance& g = press(SmallProgramme::kGoMaps);  // On maps this button feels joy instead.
  EXPECT_EQ(g.page, SmallProgramme::kMaps);
  EXPECT_EQ(g.feel, emotion::Emotion::joy);
  EXPECT_FALSE(g.says);
}

TEST_F(GuideTest, BackLeadsBack) {
  press(SmallProgramme::kGoMaps);
  EXPECT_EQ(press(SmallProgramme::kBack).page, SmallProgramme::kWelcome);
  EXPECT_EQ(press(SmallProgramme::kBack).page, SmallProgramme::kWelcome);  // Nowhere else to go.
}

TEST_F(GuideTest, LanguagesGoRoundAndHushWhatIsSaid) {
  const Guidance& g = press(SmallProgramme::kLanguage);
  EXPECT_EQ(g.language, 1);
  EXPECT_TRUE(g.hushes);
  EXPECT_EQ(press(SmallProgramme::kLanguage).language, 0);
}

TEST_F(GuideTest, ModesAreTurnedByOnePressEach) {
  EXPECT_TRUE(press(SmallProgramme::kLarge).large_text);
  EXPECT_TRUE(press(SmallProgramme::kContrast).high_contrast);
  EXPECT_FALSE(press(SmallProgramme::kLarge).large_text);
  EXPECT_TRUE(guide_.guidance().captions);
}

TEST_F(GuideTest, TheNextVisitorFindsAllAsAtFirst) {
  press(SmallProgramme::kLanguage);
  press(SmallProgramme::kLarge);
  press(SmallProgramme::kGoMaps);
  wait(9.0f);
  EXPECT_EQ(guide_.guidance().page, SmallProgramme::kMaps);  // after_s is 10.
  const Guidance& g = wait(2.0f);
  EXPECT_FALSE(g.visited);
  EXPECT_EQ(g.page, SmallProgramme::kWelcome);
  EXPECT_EQ(g.language, 0);
  EXPECT_FALSE(g.large_text);
}

TEST_F(GuideTest, NoTimeRunsOutWhileItSpeaks) {
  press(SmallProgramme::kGoMaps);
  EXPECT_TRUE(wait(60.0f, true).visited);
}

TEST_F(GuideTest, SignsOfLifeComeInTheirTime) {
  wait(61.0f);
  EXPECT_EQ(signs_, 3);  // every_s is 20.
}

TEST_F(GuideTest, ItSleepsOutsideOfTheHoursUntilAPress) {
  Moment night{2, 25, 11, 3 * 60};
  EXPECT_TRUE(guide_.step(0.03f, {}, night, false).asleep);
  const ButtonEvent event{SmallProgramme::kLarge, true, 0};
  EXPECT_FALSE(guide_.step(0.03f, {&event, 1}, night, false).asleep);
  EXPECT_FLOAT_EQ(guide_.guidance().volume, 0.3f);
  EXPECT_FALSE(guide_.step(0.03f, {}, noon_, false).asleep);
  EXPECT_FLOAT_EQ(guide_.guidance().volume, 0.8f);
}

TEST_F(GuideTest, UnknownButtonsAndReleasesDoNothing) {
  const ButtonEvent events[] = {{1, false, 0}, {0, true, 0}, {99, true, 0}};
  EXPECT_FALSE(guide_.step(0.03f, events, noon_, false).pressed);
}

TEST_F(GuideTest, ANewProgrammeKeepsThePageOfThatName) {
  press(SmallProgramme::kGoMaps);
  press(SmallProgramme::kLanguage);
  SmallProgramme other;
  guide_.take(other.programme());
  EXPECT_EQ(guide_.guidance().page, SmallProgramme::kMaps);
  EXPECT_EQ(guide_.guidance().language, 1);
}

TEST_F(GuideTest, TheSameStepsGiveTheSameGuidance) {
  Guide other;
  other.take(small_.programme());
  const std::uint16_t presses[] = {1, 2, 4, 3, 1, 5, 1};
  for (const std::uint16_t b : presses) {
    const ButtonEvent event{b, true, 0};
    const Guidance& a = press(b);
    const Guidance& c = other.step(0.03f, {&event, 1}, noon_, false);
    EXPECT_EQ(a.page, c.page);
    EXPECT_EQ(a.says, c.says);
    EXPECT_EQ(a.say, c.say);
    EXPECT_EQ(a.volume, c.volume);
  }
}

TEST(ReadProgramme, RefusesEveryFlippedByteAndEveryCut) {
  SmallProgramme small;
  std::vector<std::uint32_t> words(small.words());
  const auto block = std::as_writable_bytes(std::span(words));
  for (std::size_t at = 0; at < block.size(); ++at) {
    block[at] ^= std::byte{0x10};
    EXPECT_FALSE(read_programme(block, 0, 10).ok()) << at;
    block[at] ^= std::byte{0x10};
  }
  for (std::size_t size = 0; size < block.size(); size += 7)
    EXPECT_FALSE(read_programme(block.first(size), 0, 10).ok());
  EXPECT_TRUE(read_programme(block, 0, 10).ok());
}

TEST(ReadProgramme, NamesWhyItRefuses) {
  SmallProgramme small;
  const auto refusal = [&](auto change) {
    std::vector<std::uint32_t> words(small.words());
    change(*reinterpret_cast<ProgrammeHeader*>(words.data()),
           reinterpret_cast<std::byte*>(words.data()));
    SmallProgramme::seal(&words);
    const auto r = read_programme(std::as_bytes(std::span(words)), 0, 10);
    return static_cast<ProgrammeRefusal>(r.status.detail);
  };
  using R = ProgrammeRefusal;
  EXPECT_EQ(refusal([](auto& h, auto*) { h.magic[0] = 'X'; }), R::bad_magic);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.version = 99; }), R::version);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.font_crc = 5; }), R::other_font);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.section[2].first += 1; }), R::table);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.section[2].count = 0xFFFFFFFF; }), R::table);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.start_page = 77; }), R::table);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.text_count = 0x40000000; }), R::table);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.attract.action.page = 77; }), R::bad_action);
  EXPECT_EQ(refusal([](auto& h, auto*) { h.schedule.open[0][0] = 9999; }), R::bad_schedule);
  const auto in = [&](ProgrammeSection s, auto change) {
    return refusal([&](ProgrammeHeader& h, std::byte* block) {
      change(block + h.section[static_cast<std::size_t>(s)].first);
    });
  };
  using S = ProgrammeSection;
  EXPECT_EQ(in(S::languages,
               [](std::byte* p) {
                 reinterpret_cast<Language*>(p)->code = {9999, 1};
               }),
            R::text_range);
  EXPECT_EQ(in(S::choices, [](std::byte* p) { reinterpret_cast<Choice*>(p)->button = 0; }),
            R::bad_index);
  EXPECT_EQ(in(S::pages, [](std::byte* p) { reinterpret_cast<Page*>(p)->enter.feel = 77; }),
            R::bad_action);
  EXPECT_EQ(in(S::lines, [](std::byte* p) { reinterpret_cast<Line*>(p)->language = 9; }),
            R::bad_line);
  EXPECT_EQ(in(S::segments, [](std::byte* p) { reinterpret_cast<Segment*>(p)->text_end = 99; }),
            R::bad_segment);
  EXPECT_EQ(
      in(S::glyphs, [](std::byte* p) { reinterpret_cast<scene::ShapedGlyph*>(p)->glyph = 10; }),
      R::bad_segment);
  EXPECT_EQ(in(S::cues, [](std::byte* p) { reinterpret_cast<Cue*>(p)->at = 99; }), R::bad_cue);
}

}  // namespace
}  // namespace caryatid::agent
