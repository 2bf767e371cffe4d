#include "firmware-app/texts/ssml_parser.h"

#include <gtest/gtest.h>

namespace caryatid::app {
namespace {

using agent::CueKind;

class SsmlParser : public testing::Test {
 protected:
  ParsedText parse(const std::string& text) {
    complaints_.clear();
    SsmlContext context;
    context.languages = {"en", "el"};
    context.constants = {{"museum", "Aegis"}};
    context.complain = [this](std::size_t at, const std::string& what) {
      complaints_ += std::to_string(at) + ": " + what + "\n";
    };
    return parse_ssml(text, context);
  }
  std::string complaints_;
};

TEST_F(SsmlParser, PlainTextStaysAndBlanksCollapse) {
  EXPECT_EQ(parse(" Welcome!\n  Press   five. ").plain, "Welcome! Press five.");
  EXPECT_EQ(complaints_, "");
}

TEST_F(SsmlParser, TagsBecomeCuesAtTheirPlace) {
  const ParsedText t =
      parse("Go <emphasis>on</emphasis>.<break time='1.5s'/> <mark name='wave'/>B");
  EXPECT_EQ(t.plain, "Go on. B");
  ASSERT_EQ(t.cues.size(), 4u);
  EXPECT_EQ(t.cues[0].kind, CueKind::emphasis);
  EXPECT_EQ(t.cues[0].at, 3);
  EXPECT_EQ(t.cues[1].at, 5);
  EXPECT_EQ(t.cues[2].kind, CueKind::pause);
  EXPECT_EQ(t.cues[2].value, 1500u);
  EXPECT_EQ(t.cues[3].kind, CueKind::gesture);
  EXPECT_EQ(t.cues[3].at, 7);
  EXPECT_EQ(complaints_, "");
}

TEST_F(SsmlParser, AnUnknownTagIsSaidOnceAndItsTextSpoken) {
  EXPECT_EQ(parse("a <blink>b</blink> <blink>c</blink>").plain, "a b c");
  EXPECT_EQ(std::count(complaints_.begin(), complaints_.end(), '\n'), 1);
  EXPECT_EQ(complaints_.find("2: unknown tag <blink>"), 0u) << complaints_;
}

TEST_F(SsmlParser, LanguagesChangeAndComeBack) {
  const ParsedText t = parse("say <lang xml:lang=\"el\">τρία</lang> now");
  ASSERT_EQ(t.cues.size(), 2u);
  EXPECT_EQ(t.cues[0].value, 1u);
  EXPECT_EQ(t.cues[1].value, 0u);
  parse("<lang xml:lang='fr'>oui</lang>");
  EXPECT_NE(complaints_.find("'fr'"), std::string::npos);
}

TEST_F(SsmlParser, VariablesAndConstants) {
  const ParsedText t = parse("{museum}: {time}");
  EXPECT_EQ(t.plain, std::string("Aegis: ") + char(agent::Variable::time));
  EXPECT_EQ(parse("{nonsense}").plain, "{nonsense}");
  EXPECT_NE(complaints_.find("unknown variable {nonsense}"), std::string::npos);
  EXPECT_EQ(parse("{open").plain, "{open");
}

TEST_F(SsmlParser, EntitiesAndLoneSigns) {
  EXPECT_EQ(parse("a &lt; b &amp; c &#x3B1;").plain, "a < b & c α");
  EXPECT_EQ(parse("1 < 2").plain, "1 < 2");
  EXPECT_NE(complaints_.find("lone '<'"), std::string::npos);
  EXPECT_EQ(parse("a <b").plain, "a <b");
  EXPECT_NE(complaints_.find("without its '>'"), std::string::npos);
  EXPECT_EQ(parse("R&D; x").plain, "R&D; x");
}

TEST_F(SsmlParser, EmptyTagsAreUnknownTags) {
  for (const char* text : {"a</>b", "a</ >b", "a</x/>b", "a</></>b"})
    EXPECT_EQ(parse(text).plain, "ab") << text;
  EXPECT_EQ(parse("a<>b").plain, "a<>b");
}

TEST_F(SsmlParser, TagsThatDoNotPairAreClosed) {
  const ParsedText t = parse("<emphasis>for ever");
  EXPECT_EQ(t.cues.back().kind, CueKind::emphasis);
  EXPECT_EQ(t.cues.back().value, 0u);
  EXPECT_NE(complaints_, "");
  EXPECT_EQ(parse("</emphasis>x").plain, "x");
  EXPECT_NE(complaints_.find("closes nothing"), std::string::npos);
}

TEST_F(SsmlParser, WrongAttributesAreNamed) {
  parse("<break time='soon'/>");
  EXPECT_NE(complaints_.find("'soon'"), std::string::npos);
  parse("<break time='nanms'/>");
  EXPECT_NE(complaints_.find("'nanms'"), std::string::npos);
  parse("<mark name='jump'/>");
  EXPECT_NE(complaints_.find("'jump'"), std::string::npos);
  parse("<say-as interpret-as='song'>x</say-as>");
  EXPECT_NE(complaints_.find("'song'"), std::string::npos);
}

TEST_F(SsmlParser, AMegabyteIsCutAtAWordWithOneComplaint) {
  std::string text;
  while (text.size() < (1u << 20)) text += "καλώς ";
  const ParsedText t = parse(text);
  EXPECT_LE(t.plain.size(), kMaxTextBytes);
  EXPECT_GT(t.plain.size(), kMaxTextBytes - 32);
  EXPECT_EQ(t.plain.substr(t.plain.size() - 3), "…");
  EXPECT_EQ(std::count(complaints_.begin(), complaints_.end(), '\n'), 1);
}

TEST_F(SsmlParser, ManyCuesInNothingStayOrdered) {
  const ParsedText t = parse("<p/><p/>a<p/><p/>b<break/><break/>");
  EXPECT_EQ(t.plain, "a\nb");
  for (std::size_t i = 1; i < t.cues.size(); ++i) EXPECT_GE(t.cues[i].at, t.cues[i - 1].at);
}

}  // namespace
}  // namespace caryatid::app
