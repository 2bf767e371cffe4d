#include "firmware-app/texts/compile.h"

#include "core/agent/describe.h"
#include "core/agent/guide.h"
#include "core/agent/ssml.h"
#include "tests/unit/firmware-app/texts/desk_of.h"

namespace caryatid::app {
namespace {

const std::string kButton = "[[button]]\nname = '1'\n";

std::string config(const std::string& more) {
  return "languages = ['en', 'el']\n" + more + kButton;
}

void expect_message(const DeskOf& desk, const std::string& words) {
  EXPECT_NE(desk.messages().find(words), std::string::npos) << desk.messages();
  EXPECT_FALSE(desk.compiled.block.empty());  // Whatever is wrong, there is a programme.
}

std::vector<BuiltinFile> default_programme() {
  static std::string texts[3];
  std::vector<BuiltinFile> files;
  const char* names[] = {"kiosk.toml", "texts/en.toml", "texts/el.toml"};
  for (int i = 0; i < 3; ++i) {
    texts[i] = file_text(kSource + "/assets/programme/" + names[i]);
    files.push_back({names[i], texts[i]});
  }
  return files;
}

TEST(Compile, TheDefaultProgrammeIsWithoutFault) {
  DeskOf desk(default_programme());
  EXPECT_EQ(desk.messages(), "");
  ASSERT_EQ(desk.programme.languages.size(), 2u);
  EXPECT_LT(desk.compiled.block.size(), kMaxProgrammeBytes / 4);
  EXPECT_EQ(desk.said(0, 0), "Welcome! Press five for maps.");
  EXPECT_EQ(desk.said(0, 1), "Καλώς ήρθατε! Πατήστε πέντε για χάρτες.");
  for (const char* name : {"joy", "sadness", "anger", "fear", "disgust", "surprise", "calm"})
    EXPECT_GE(desk.programme.find_button(name), 0) << name;
}

// A visitor at the default desk.
class DefaultDesk : public ::testing::Test {
 protected:
  DefaultDesk() { guide_.take(desk_.programme); }
  const agent::Guidance& press(const char* name, const agent::Moment& now = kOpen) {
    const int index = desk_.programme.find_button(name);
    EXPECT_GE(index, 0) << name;
    const ButtonEvent event{static_cast<std::uint16_t>(index + 1), true, 0};
    return guide_.step(0.03f, {&event, 1}, now, false);
  }
  static constexpr agent::Moment kOpen{2, 25, 11, 11 * 60}, kNight{3, 26, 11, 20 * 60};
  DeskOf desk_{default_programme()};
  agent::Guide guide_;
};

// On every page, in each language: one button for the letters, one for the contrast, each on and
// off again; 2 reads the page aloud from the first one.
TEST_F(DefaultDesk, TwoButtonsMakeEveryPageReadable) {
  for (const char* page : {"1", "3", "4", "5", "6", "7"}) {
    press("1");
    press(page);
    EXPECT_TRUE(guide_.guidance().captions) << page;
    EXPECT_TRUE(press("8").large_text) << page;
    EXPECT_TRUE(press("9").high_contrast) << page;
    EXPECT_TRUE(guide_.guidance().large_text) << page;
    EXPECT_FALSE(press("8").large_text) << page;
    EXPECT_FALSE(press("9").high_contrast) << page;
  }
  press("1");
  EXPECT_TRUE(press("2").describes);
}

TEST_F(DefaultDesk, ATicketsCodeIsAnEventLikeAButton) {
  const agent::Guidance& g = press("ticket");
  EXPECT_TRUE(g.says && g.feels);
  EXPECT_EQ(g.feel, emotion::Emotion::joy);
  EXPECT_EQ(g.gesture, body::GestureKind::nod);
  EXPECT_NE(desk_.programme.line(g.say, 0), nullptr);
}

TEST_F(DefaultDesk, NightIsQuieterAndTheVisitorHasASay) {
  EXPECT_FLOAT_EQ(press("1").volume, 0.8f);
  EXPECT_FLOAT_EQ(press("1", kNight).volume, 0.4f);
  press("6", kNight);
  EXPECT_GT(press("2", kNight).volume, 0.4f);
}

// The page of maps for a visitor who does not see it.
TEST(Describe, SaysTitleTextPictureAndMenu) {
  DeskOf desk(
      {{"kiosk.toml",
        "[[picture]]\nname = 'm'\nfile = 'm.png'\n[[page]]\nname = 'p'\n"
        "show = 'm'\n[page.on]\n'5' = { go = 'p' }\n[[button]]\nname = '5'\n"},
       {"texts/en.toml", "[p]\ntitle = 'Maps'\nbody = 'Here.'\n[picture]\nm = 'A plan'\n"}});
  EXPECT_EQ(desk.messages(), "");
  agent::Guidance shown;
  shown.picture = 0;
  agent::describe(desk.programme, shown, {}, &desk.expanded);
  const std::string text(desk.expanded.text.begin(), desk.expanded.text.end());
  EXPECT_EQ(text, "Maps Here. A plan 5: Maps");
  scene::TextLines lines;
  scene::break_lines(desk.expanded.runs.span(), 1 << 20, &lines);
  EXPECT_EQ(lines.size(), 4u);
  EXPECT_EQ(desk.expanded.cues.size(), 3u);  // A pause before each part but the first.
}

TEST(Compile, VariablesAreFilledIn) {
  DeskOf desk({{"kiosk.toml", config("[hours]\nmonday = '9:00-17:30'\n[[page]]\nname = 'p'\n")},
               {"texts/en.toml",
                "[p]\nsay = 'At {time}: {weekday} {day} {month}, {opening_hours}, "
                "{open_state}.'\n"},
               {"texts/el.toml",
                "name = 'Ελληνικά'\nclosed = 'κλειστά'\nopen = 'ανοιχτά'\n"
                "[p]\nsay = '{opening_hours}, {open_state}'\n"}});
  EXPECT_EQ(desk.messages(), "");
  const agent::Moment monday{0, 5, 10, 9 * 60 + 5}, tuesday{1, 16, 1, 600};
  EXPECT_EQ(desk.said(0, 0, monday), "At 09:05: Monday 5 October, 9:00–17:30, open.");
  std::int32_t width = 0;
  for (const scene::Run& r : desk.expanded.runs) {
    EXPECT_GT(r.width, 0);
    width += r.width;
  }
  EXPECT_EQ(desk.said(0, 0, tuesday), "At 10:00: Tuesday 16 January, closed, closed.");
  EXPECT_EQ(desk.said(0, 1, tuesday), "κλειστά, κλειστά");
}

TEST(Compile, AMissingTranslationFallsBack) {
  DeskOf desk({{"kiosk.toml", config("[[page]]\nname = 'p'\n")},
               {"texts/en.toml", "[p]\nsay = 'Hello'\n"},
               {"texts/el.toml", "name = 'x'\n"}});
  expect_message(desk, "texts/el.toml: there is no 'p.say'; translate it from texts/en.toml");
  EXPECT_EQ(desk.said(0, 1), "Hello");
  EXPECT_EQ(desk.expanded.language, 0);  // So that the right voice speaks it.
}

TEST(Compile, AMissingLanguageFallsBack) {
  DeskOf desk({{"kiosk.toml", config("[[page]]\nname = 'p'\n")},
               {"texts/en.toml", "[p]\nsay = 'Hello'\n"}});
  expect_message(desk, "texts/el.toml: is not built in");
  EXPECT_EQ(desk.said(0, 1), "Hello");
}

TEST(Compile, ABrokenTextFileNamesItsLineAndFallsBack) {
  DeskOf desk({{"kiosk.toml", config("[[page]]\nname = 'p'\n")},
               {"texts/en.toml", "[p]\nsay = 'Hello'\n"},
               {"texts/el.toml", "[p]\nsay = \n"}});
  expect_message(desk, "texts/el.toml:2: ");
  EXPECT_EQ(desk.said(0, 1), "Hello");
}

TEST(Compile, FaultsInTextsNameTheirLine) {
  DeskOf desk({{"kiosk.toml", config("[[page]]\nname = 'p'\n")},
               {"texts/en.toml", "[p]\nsay = '''\nfine\nnot <blink>fine</blink>'''\n"},
               {"texts/el.toml", "[p]\nsay = 'a {what} b'\n"}});
  expect_message(desk, "texts/en.toml:4: 'p.say': unknown tag <blink>");
  expect_message(desk, "texts/el.toml:2: 'p.say': unknown variable {what}");
  EXPECT_EQ(desk.said(0, 0), "fine not fine");
}

TEST(Compile, InvalidUtf8IsReplacedAndSaid) {
  DeskOf desk({{"kiosk.toml", config("[[page]]\nname = 'p'\n")},
               {"texts/en.toml", "[p]\nsay = 'caf\xE9 au lait'\n"},
               {"texts/el.toml", "[p]\nsay = 'α'\n"}});
  expect_message(desk, "texts/en.toml:2: not UTF-8");
  EXPECT_EQ(desk.said(0, 0), "caf\uFFFD au lait");
}

TEST(Compile, ATextOfAMegabyteIsRefusedWithItsFile) {
  const std::string much = "[p]\nsay = '" + std::string(1u << 20, 'a') + "'\n";
  const auto folder = testing::TempDir() + "/megabyte";
  (void)std::system(("mkdir -p " + folder + "/texts").c_str());
  std::ofstream(folder + "/kiosk.toml") << config("[[page]]\nname = 'p'\n");
  std::ofstream(folder + "/texts/en.toml") << much;
  std::ofstream(folder + "/texts/el.toml") << "[p]\nsay = 'α'\n";
  ProgrammeFiles files(folder + "/kiosk.toml", {});
  const CompiledProgramme compiled = compile_programme(files, test_font());
  ASSERT_FALSE(compiled.messages.all().empty());
  EXPECT_NE(compiled.messages.all()[0].line.find("texts/en.toml: is larger than"),
            std::string::npos);
  EXPECT_FALSE(compiled.block.empty());
}

TEST(Compile, FaultsOfTheConfigurationNameTheirLine) {
  const struct {
    const char* text;
    const char* words;
  } kCases[] = {
      {"colour = 'red'\n", "kiosk.toml:2: unknown key 'colour'"},
      {"start = 'nowhere'\n[[page]]\nname = 'p'\n", "kiosk.toml:2: there is no page 'nowhere'"},
      {"[hours]\nmonday = '9-17'\n", "kiosk.toml:3: '9' is no time"},
      {"[hours]\nmonday = '18:00-9:00'\n", "kiosk.toml:3: it closes before it opens"},
      {"volume = 7\n", "kiosk.toml:2: a volume"},
      {"[attract]\nafter_s = -1\n", "kiosk.toml:3: after_s"},
      {"[[page]]\nname = 'p'\nshow = 'x'\n", "kiosk.toml:4: there is no picture 'x'"},
      {"[[page]]\nname = 'p'\nfeel = 'bliss'\n", "kiosk.toml:4: there is no feeling 'bliss'"},
      {"[[page]]\nname = 'p'\n[page.on]\n'9' = { go = 'p' }\n",
       "kiosk.toml:5: there is no button '9'"},
      {"[[page]]\nname = 'p'\nsay = 'nothing'\n", "no language has the text 'nothing'"},
      {"sleep = 7\n", "kiosk.toml:2: sleep is true or false"},
      {"page = 'p'\n", "kiosk.toml:2: page is a list; write [[page]]"},
      {"start = 5\n", "kiosk.toml:2: page: its name is wanted, in quotation marks"},
      {"[[page]]\nname = 'p'\n[[page]]\nname = 'p'\n", "kiosk.toml:4: page 'p' is there twice"},
      {"[[picture]]\nname = 'm'\n", "kiosk.toml:2: a picture needs a name and a file"},
  };
  for (const auto& c : kCases) {
    DeskOf desk({{"kiosk.toml", config(c.text)}, {"texts/en.toml", ""}, {"texts/el.toml", ""}});
    expect_message(desk, c.words);
  }
}

TEST(Compile, LanguagesAreCodesAndEachOnce) {
  const struct {
    const char* text;
    const char* words;
  } kCases[] = {{"languages = []\n", "kiosk.toml:1: languages is empty"},
                {"languages = 'en'\n", "kiosk.toml:1: languages is a list"},
                {"languages = ['en', 5]\n", "kiosk.toml:1: a language is a code"},
                {"languages = ['en', 'en']\n", "kiosk.toml:1: language 'en' is there twice"}};
  for (const auto& c : kCases) {
    DeskOf desk({{"kiosk.toml", c.text}, {"texts/en.toml", ""}});
    expect_message(desk, c.words);
  }
}

TEST(Compile, ABrokenConfigurationGivesItsLineAndNoProgramme) {
  DeskOf desk(std::vector<BuiltinFile>{{"kiosk.toml", "languages = [\n"}});
  EXPECT_TRUE(desk.compiled.block.empty());
  EXPECT_NE(desk.messages().find("kiosk.toml:"), std::string::npos);
}

TEST(Compile, TooMuchTextIsRefused) {
  std::string texts = "[p]\n", pages;
  for (int i = 0; i < 64; ++i) {
    pages +=
        "[[page]]\nname = 'p" + std::to_string(i) + "'\nsay = 'p.t" + std::to_string(i) + "'\n";
    texts += "t" + std::to_string(i) + " = '" + std::string(4000, 'a') + "'\n";
  }
  DeskOf desk({{"kiosk.toml", config(pages)}, {"texts/en.toml", texts}, {"texts/el.toml", ""}});
  EXPECT_NE(desk.messages().find("KiB; it may take 512"), std::string::npos) << desk.messages();
  EXPECT_TRUE(desk.compiled.block.empty());
}

TEST(Ssml, WordsOfTheVoiceAreFoundInThePlainText) {
  DeskOf desk({{"kiosk.toml", config("[[page]]\nname = 'p'\n")},
               {"texts/en.toml",
                "[p]\nsay = 'A &amp; <emphasis>B</emphasis>, <break/>"
                "<lang xml:lang=\"el\">τρία</lang> < &lt;'\n"},
               {"texts/el.toml", "[p]\nsay = 'α'\n"}});
  const std::string plain = desk.said(0, 0);
  EXPECT_EQ(plain, "A & B, τρία < <");
  const auto ssml = std::make_unique<agent::Ssml>();
  ssml->write(desk.programme, desk.expanded);
  const std::string text(ssml->text());
  EXPECT_EQ(text,
            "<speak>A &amp; <emphasis>B</emphasis>, <break time=\"500ms\"/><lang xml:lang=\"el\">"
            "τρία</lang><lang xml:lang=\"en\"> &lt; &lt;</lang></speak>");
  for (const std::string word : {"B", "τρία"})
    EXPECT_EQ(ssml->plain_byte(static_cast<std::uint32_t>(text.find(word))), plain.find(word));
  EXPECT_EQ(ssml->plain_byte(0), 0u);
  EXPECT_LE(ssml->plain_byte(60000), 60000u);
}

}  // namespace
}  // namespace caryatid::app
