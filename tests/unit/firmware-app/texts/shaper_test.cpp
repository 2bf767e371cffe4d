// Shaping and line breaking against facts of the scripts, not against kept output.
#include "firmware-app/texts/shaper.h"

#include "tests/unit/firmware-app/texts/desk_of.h"

namespace caryatid::app {
namespace {

ShapedText shape(std::string_view text, std::string_view language = "en") {
  static const Shaper shaper(test_font());
  ShapeRequest request;
  request.plain = text;
  request.language = language;
  request.samples.fill(U'0');
  return shaper.shape(request);
}

std::vector<std::string> pieces(std::string_view text, const ShapedText& shaped) {
  std::vector<std::string> out;
  for (const agent::Segment& s : shaped.segments)
    out.emplace_back(text.substr(s.text_begin, s.text_end - s.text_begin));
  return out;
}

TEST(Shaper, WordsAndBlanksAlternate) {
  const std::string_view text = "Press five now.";
  const ShapedText t = shape(text);
  EXPECT_EQ(pieces(text, t), (std::vector<std::string>{"Press", " ", "five", " ", "now."}));
  for (std::size_t i = 0; i < t.segments.size(); ++i) {
    EXPECT_EQ((t.segments[i].flags & agent::kBlank) != 0, i % 2 == 1);
    EXPECT_EQ((t.segments[i].flags & agent::kBreakAfter) != 0, i % 2 == 1);
    EXPECT_GT(t.segments[i].width, 0u);
  }
}

TEST(Shaper, BreaksFollowTheUnicodeRules) {
  // No break between a number and its unit sign, after a slash-less bracket, at a no-break space.
  EXPECT_EQ(pieces("(a) 50% b", shape("(a) 50% b")).size(), 5u);
  for (const agent::Segment& s : shape("a\u00A0b").segments)
    EXPECT_EQ(s.flags & agent::kBreakAfter, 0);
  // A hyphen may end a line.
  EXPECT_EQ(pieces("well-kept", shape("well-kept")), (std::vector<std::string>{"well-", "kept"}));
}

TEST(Shaper, EveryScriptOfTheFontHasGlyphs) {
  for (const char* text : {"Welcome", "Καλώς ήρθατε", "ἄνθρωπος ᾠδῇ", "Добро пожаловать",
                           "ברוכים הבאים", "أهلا وسهلا", "Dobrý večer, ğüşıöç"}) {
    const ShapedText t = shape(text);
    EXPECT_TRUE(t.missing.empty()) << text;
    for (const scene::ShapedGlyph& g : t.glyphs)
      EXPECT_NE(test_font().glyphs[g.glyph].glyph_id, 0) << text;
  }
}

TEST(Shaper, WhatTheFontLacksIsNamed) {
  const ShapedText t = shape("a 中 b");
  ASSERT_EQ(t.missing.size(), 1u);
  EXPECT_EQ(t.missing[0], U'中');
}

TEST(Shaper, RightToLeftRunsAreOddAndDigitsInThemEven) {
  const ShapedText t = shape("שלום 17 לך", "he");
  ASSERT_EQ(t.segments.size(), 5u);
  EXPECT_EQ(t.segments[0].level % 2, 1);
  EXPECT_EQ(t.segments[2].level, 2);
  EXPECT_EQ(t.segments[4].level % 2, 1);
}

TEST(Shaper, HebrewGlyphsStandInVisualOrder) {
  const ShapedText whole = shape("אב", "he"), first = shape("א", "he");
  ASSERT_EQ(whole.glyphs.size(), 2u);
  EXPECT_EQ(whole.glyphs[1].glyph, first.glyphs[0].glyph);  // Read first, drawn rightmost.
}

TEST(Shaper, ArabicLettersJoin) {
  // Lam and alef become one glyph; beh has another form alone than before another letter.
  EXPECT_LT(shape("لا", "ar").glyphs.size(), 3u);
  const ShapedText alone = shape("ب", "ar"), joined = shape("بب", "ar");
  EXPECT_NE(joined.glyphs.back().glyph, alone.glyphs.front().glyph);
}

TEST(Shaper, AVariableIsASegmentOfItsOwn) {
  const std::string text = std::string("at ") + '\1' + ".";
  const ShapedText t = shape(text);
  ASSERT_EQ(t.segments.size(), 4u);
  EXPECT_EQ(t.segments[2].variable, 1);
  EXPECT_EQ(t.segments[2].glyph_count, 0);
  EXPECT_EQ(t.segments[2].flags & agent::kBreakAfter, 0);  // The full stop stays with it.
}

TEST(Shaper, ALineFeedEndsALine) {
  const ShapedText t = shape("a\nb");
  bool must = false;
  for (const agent::Segment& s : t.segments) must = must || (s.flags & agent::kMustBreak) != 0;
  EXPECT_TRUE(must);
}

}  // namespace
}  // namespace caryatid::app
