// The whole program speaking: sound and mouth of a run are the same bit for bit, and whatever is
// wrong with voice or text, she stays and her words pass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/golden/program/pixels.h"
#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

using ::testing::HasSubstr;

const std::string kQuiet = " --display none --view head --virtual-clock --duration ";

class Speech : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::filesystem::path(CARYATID_PROGRAM).parent_path() /
                                 "caryatid-voice"))
      GTEST_SKIP() << "needs caryatid-voice; install libespeak-ng-dev and build again";
    folder_ = fresh_folder("speech");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Outcome say(const std::string& arguments, const std::string& seconds = "3") {
    return run_program("--audio file:" + wav().string() + " --metrics " + metrics().string() +
                       kQuiet + seconds + " " + arguments);
  }
  std::filesystem::path wav() const { return folder_ / "a.wav"; }
  std::filesystem::path metrics() const { return folder_ / "m.jsonl"; }

  // Seconds until the first sample that is not silent; negative: there is none.
  double first_sound_s() const {
    const std::string bytes = content(wav());
    for (std::size_t i = 44; i + 1 < bytes.size(); i += 2) {
      std::int16_t sample = 0;
      std::memcpy(&sample, &bytes[i], 2);
      if (std::abs(int{sample}) > 100) return static_cast<double>((i - 44) / 2) / 22050.0;
    }
    return -1.0;
  }
  // Greatest value of a number in the metrics' lines.
  double most(const std::string& name) const {
    const std::string text = content(metrics()), key = "\"" + name + "\":";
    double out = -1e9;
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
      out = std::max(out, std::atof(text.c_str() + at + key.size()));
    return out;
  }

  std::filesystem::path folder_;
};

TEST_F(Speech, TwoRunsSoundAndLookTheSame) {
  ASSERT_EQ(say("--say 'Welcome! Press five for maps.'").exit_code, 0);
  const std::string sound = content(wav()), mouth = content(metrics());
  ASSERT_EQ(say("--say 'Welcome! Press five for maps.'").exit_code, 0);
  EXPECT_EQ(content(wav()), sound);
  EXPECT_EQ(content(metrics()), mouth);
  EXPECT_GT(most("jaw"), 250.0);
}

TEST_F(Speech, FirstSoundComesWithin150Milliseconds) {
  ASSERT_EQ(say("--say 'Aha.'").exit_code, 0);
  EXPECT_GE(first_sound_s(), 0.0);
  EXPECT_LE(first_sound_s(), 0.150);
}

TEST_F(Speech, NothingIsAllocatedWhileSheSpeaks) {
  EXPECT_THAT(say("--say 'Welcome! Press five for maps.'").output,
              HasSubstr("0 allocations after the seal"));
}

TEST_F(Speech, AMissingLanguageLeavesTheWords) {
  const Outcome run = say("--say 'one two three' --language tlh");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("does not know this language"));
  EXPECT_LT(first_sound_s(), 0.0);
  EXPECT_EQ(most("word"), 2.0);
}

// A programme in Klingon, which the voice does not know, and English.
TEST_F(Speech, AMissingLanguageGoesOnInTheNextOne) {
  std::filesystem::create_directories(folder_ / "texts");
  const auto config = write_file(folder_ / "kiosk.toml",
                                 "languages = ['tlh', 'en']\n[[page]]\nname = 'p'\n"
                                 "[[button]]\nname = '1'\ngo = 'p'\n");
  write_file(folder_ / "texts/tlh.toml", "voice = 'tlh'\n[p]\nsay = 'nuqneH'\n");
  write_file(folder_ / "texts/en.toml", "voice = 'en'\n[p]\nsay = 'What do you want now'\n");
  const auto script = write_file(folder_ / "script", "0.1 1 down\n0.2 1 up\n3 1 down\n");
  const Outcome run = say("--config " + config.string() + " --script " + script.string(), "5");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("goes on in en, the next language"));
  EXPECT_GE(first_sound_s(), 0.1);
  EXPECT_LE(first_sound_s(), 0.6);
  EXPECT_EQ(most("word"), 4.0);
  // Once is enough: the second time the voice is not asked for Klingon any more.
  EXPECT_EQ(run.output.find("goes on in"), run.output.rfind("goes on in")) << run.output;
}

// The feeling of the button colours the sentence that it says.
TEST_F(Speech, AFeelingIsHeard) {
  const std::string arguments = "--script " + (folder_ / "script").string() + " --config " +
                                (folder_ / "kiosk.toml").string();
  std::filesystem::create_directories(folder_ / "texts");
  write_file(folder_ / "texts/en.toml", "[p]\nsay = 'The museum is open until nine.'\n");
  write_file(folder_ / "script", "0 1 down\n");
  std::vector<double> heard_ms;
  for (const char* feel : {"calm", "joy", "sadness"}) {
    write_file(folder_ / "kiosk.toml", std::string("[[page]]\nname = 'p'\nfeel = '") + feel +
                                           "'\n[[button]]\nname = '1'\ngo = 'p'\n");
    ASSERT_EQ(say(arguments, "5").exit_code, 0);
    heard_ms.push_back(most("heard_ms"));
  }
  EXPECT_LT(heard_ms[1], 0.97 * heard_ms[0]);
  EXPECT_GT(heard_ms[2], 1.01 * heard_ms[0]);
}

// What another program lets her say is read, too, word by word.
TEST_F(Speech, ATextOfTheCommandLineHasCaptions) {
  const auto dark = [this](const std::string& more) {
    const Outcome run = run_program(more + " --display surfaceless --size 320x192 --virtual-clock" +
                                    " --audio null --duration 1.01 --frames-every 30" +
                                    " --frames-out " + folder_.string());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    const Pixels p = read_png(folder_ / "frame_00030.png");
    // Near black among the picture's lower middle: the ground of captions.
    std::size_t count = 0;
    for (int y = p.height * 7 / 10; y < p.height; ++y)
      for (int x = p.width / 4; x < p.width * 3 / 4; ++x)
        count += p.rgb[p.at(x, y)] < 40 && p.rgb[p.at(x, y) + 2] < 50;
    return count;
  };
  const std::size_t without = dark("");
  EXPECT_GT(dark("--say 'Welcome to the museum of Caryatids'"), without + 1500);
}

TEST_F(Speech, AMissingVoiceLeavesTheWords) {
  const Outcome run = say("--say 'one two three' --voice /nowhere/voice");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("/nowhere/voice"));
  EXPECT_EQ(most("word"), 2.0);
}

TEST_F(Speech, AVoiceThatDiesLeavesTheWords) {
  const Outcome run = say("--say 'one two three' --voice /bin/false", "6");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(most("word"), 2.0);
}

TEST_F(Speech, ACrashCostsOneSentence) {
  // The fake voice of platform/voice's tests, under the name that makes it crash on "bad".
  const auto fake = std::filesystem::path(CARYATID_PROGRAM).parent_path() / "fake-voice";
  if (!std::filesystem::exists(fake)) GTEST_SKIP() << "needs fake-voice; build all targets";
  std::filesystem::create_symlink(fake, folder_ / "fake-crash");
  const Outcome run =
      say("--say 'A bad one. Fine here.' --voice " + (folder_ / "fake-crash").string(), "8");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("crashed"));
  // The second sentence, 10 letters of 100 samples each, is heard: 100 samples of the first too.
  const std::string sound = content(wav());
  const auto silent = std::count(sound.begin() + 44, sound.end(), '\0');
  const auto heard = static_cast<std::ptrdiff_t>(sound.size()) - 44 - silent;
  EXPECT_GE(heard, 1100);
  EXPECT_LE(heard, 2 * 1100);
}

TEST_F(Speech, ARecordingOfTheTextPlaysInPlaceOfTheVoice) {
  // A tenth of a second at 44 100 Hz, under the name of the text "a".
  const std::filesystem::path name = folder_ / "af63dc4c8601ec8c-en";
  std::string wav(
      "RIFF\x8c\x22\0\0WAVEfmt \x10\0\0\0\1\0\1\0\x44\xac\0\0\x88\x58\1\0\2\0\x10\0data", 40);
  wav += std::string("\x68\x22\0\0", 4) + std::string(2 * 4404, '\x10');
  write_file(name.string() + ".wav", wav);
  write_file(name.string() + ".timing",
             "caryatid-timing 1\nword 0 0 1\nphone 0 \xC9\x91\nend 99\n");
  const Outcome run = say("--say a --recordings " + folder_.string());
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, ::testing::Not(HasSubstr("captions go on"))) << run.output;
  const std::string sound = content(this->wav());
  const auto silent = std::count(sound.begin() + 44, sound.end(), '\0');
  EXPECT_NEAR(static_cast<double>(sound.size()) - 44.0 - static_cast<double>(silent), 4404.0, 60.0);
  EXPECT_EQ(most("word"), 0.0);
}

TEST_F(Speech, InvalidUtf8IsSpokenAsFarAsItIsText) {
  const Outcome run = say("--say \"$(printf 'good \\377\\376 morning')\"");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_GE(first_sound_s(), 0.0);
}

TEST_F(Speech, ATextThatIsTooLongIsCut) {
  const Outcome run =
      say("--say \"$(head -c 100000 /dev/zero | tr '\\0' 'a' | sed 's/aaaaaaa/word /g')\"");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("too long"));
  EXPECT_GE(first_sound_s(), 0.0);
}

TEST_F(Speech, AFullDiskCostsTheFileNotTheShow) {
  const Outcome run = run_program("--say hello --audio file:/dev/full" + kQuiet + "2");
  EXPECT_EQ(run.exit_code, 0);
}

TEST_F(Speech, AnUnknownAudioKindIsWrongUsage) {
  EXPECT_EQ(run_program("--audio gramophone" + kQuiet + "1").exit_code, 2);
}

}  // namespace
}  // namespace caryatid::golden
