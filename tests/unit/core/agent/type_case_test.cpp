// Captions of texts that nobody compiled.
#include "core/agent/type_case.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace caryatid::agent {
namespace {

// Glyph n is letter n of "a b c ... alpha ... alef ...", each as wide as its number.
const std::vector<TypeLetter>& letters() {
  static const std::vector<TypeLetter> all = [] {
    std::vector<TypeLetter> out;
    std::uint16_t n = 0;
    for (const char32_t code : {U' ', U'a', U'b', U'c', U'α', U'β', U'א', U'ב'})
      out.push_back({code, n++, static_cast<std::int16_t>(100 + n)});
    return out;
  }();
  return all;
}

struct Caption {
  std::unique_ptr<Utterable> set = std::make_unique<Utterable>();
  std::uint32_t end = 0;
  explicit Caption(std::string_view text, std::uint32_t from = 0)
      : end(TypeCase(letters()).set(text, from, set.get())) {}
  std::string run(std::size_t i) const {
    const scene::Run& r = set->runs[i];
    return std::string(set->text.begin() + r.text_begin, set->text.begin() + r.text_end);
  }
};

TEST(TypeCase, SetsWordsAndBlanksByTheirBytes) {
  const Caption c("ab αβ  c");
  ASSERT_EQ(c.set->runs.size(), 5u);
  EXPECT_EQ(c.run(0), "ab");
  EXPECT_EQ(c.run(2), "αβ");
  EXPECT_TRUE(c.set->runs[3].blank);
  EXPECT_TRUE(c.set->runs[3].break_after);
  EXPECT_FALSE(c.set->runs[2].break_after);
  EXPECT_EQ(c.set->runs[2].text_begin, 3);
  EXPECT_EQ(c.set->runs[2].text_end, 7);
  EXPECT_EQ(c.set->runs[2].width, 105 + 106);
  EXPECT_EQ(c.set->runs[2].glyphs[1].glyph, 5);
  EXPECT_EQ(c.end, 10u);
}

TEST(TypeCase, RightToLeftWordsAreTurnedAndKeepTogether) {
  const Caption c("a אב ב");
  ASSERT_EQ(c.set->runs.size(), 5u);
  EXPECT_EQ(c.set->runs[2].level, 1);
  EXPECT_EQ(c.set->runs[2].glyphs[0].glyph, 7);  // The last letter is the leftmost.
  EXPECT_EQ(c.set->runs[3].level, 1);
  EXPECT_EQ(c.set->runs[1].level, 0);
  std::array<std::uint16_t, 5> order{};
  scene::visual_order(c.set->runs.span(), order);
  EXPECT_EQ(order, (std::array<std::uint16_t, 5>{0, 1, 4, 3, 2}));
}

TEST(TypeCase, LettersThatTheFontLacksAreLeftOut) {
  const Caption c("a☃b");
  ASSERT_EQ(c.set->runs.size(), 1u);
  EXPECT_EQ(c.set->runs[0].glyphs.size(), 2u);
  EXPECT_EQ(c.set->runs[0].text_end, 5);
}

TEST(TypeCase, ALongTextIsSetPieceByPieceAndLosesNoWord) {
  std::string text;
  while (text.size() < 6000) text += "abc αβ ";
  std::string together;
  std::uint32_t from = 0;
  for (int pieces = 0; from < text.size(); ++pieces) {
    ASSERT_LT(pieces, 30);
    const Caption c(text, from);
    ASSERT_GT(c.end, from);
    for (std::size_t i = 0; i < c.set->runs.size(); ++i) together += c.run(i);
    EXPECT_EQ(together.size(), c.end);
    from = c.end;
  }
  EXPECT_EQ(together, text);
}

TEST(TypeCase, AWordWithoutEndIsBroken) {
  const Caption c(std::string(100, 'a'));
  ASSERT_EQ(c.set->runs.size(), 4u);
  EXPECT_TRUE(c.set->runs[0].break_after);
  EXPECT_EQ(c.set->runs[0].glyphs.size(), 32u);
}

TEST(TypeCase, ATextCutInTheMiddleOfALetterOrOfNothingIsHarmless) {
  EXPECT_EQ(Caption("a\xCE").end, 2u);
  EXPECT_EQ(Caption("").set->runs.size(), 0u);
  EXPECT_EQ(Caption("abc", 7).set->runs.size(), 0u);
}

}  // namespace
}  // namespace caryatid::agent
