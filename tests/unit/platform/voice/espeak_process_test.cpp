// The client of the voice program against programs that crash, hang, lie and send garbage: one
// utterance is lost each time, never more, and never the caller's time.
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "platform/clock/clock.h"
#include "platform/voice/voice.h"

namespace caryatid::platform {
namespace {

class EspeakProcess : public ::testing::Test {
 protected:
  // The fake under a name that says how it behaves.
  std::unique_ptr<Voice> start(const std::string& how) {
    folder_ =
        std::filesystem::temp_directory_path() / ("caryatid-voice-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    const std::string path = (folder_ / ("fake-" + how)).string();
    std::filesystem::remove(path);
    std::filesystem::create_symlink(CARYATID_FAKE_VOICE, path);
    std::unique_ptr<Voice> voice;
    ErrorLine error;
    EXPECT_TRUE(open_espeak_process(path.c_str(), voice, error).ok()) << error.c_str();
    return voice;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // Waits for the program's hello (again, after a crash), at most 5 s.
  static bool wait_ready(Voice& voice) {
    auto u = std::make_unique<speech::Utterance>();
    std::size_t count = 0;
    for (int i = 0; i < 250 && !voice.ready(); ++i) {
      (void)voice.pump(monotonic_us(), {}, &count, u.get());
      usleep(20'000);
    }
    return voice.ready();
  }

  struct Heard {
    Status status;
    std::vector<std::int16_t> samples;
    std::unique_ptr<speech::Utterance> utterance = std::make_unique<speech::Utterance>();
  };
  // Says and takes all of it. skip_us: what the clock is ahead, to see time-outs at once.
  static Heard hear(Voice& voice, std::string_view text, std::int64_t skip_us = 0) {
    Heard out;
    out.status = voice.say({.text = text}, monotonic_us());
    if (!out.status.ok()) return out;
    std::vector<std::int16_t> piece(512);
    for (int i = 0; i < 500 && out.status.ok() && !out.utterance->finished(); ++i) {
      pollfd fd{voice.descriptor(), POLLIN, 0};
      (void)poll(&fd, 1, 10);
      std::size_t count = 0;
      // Time jumps once the program has had its chance.
      const std::int64_t now_us = monotonic_us() + (i > 20 ? skip_us : 0);
      out.status = voice.pump(now_us, piece, &count, out.utterance.get());
      out.samples.insert(out.samples.end(), piece.begin(),
                         piece.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return out;
  }
  static VoiceTrouble trouble(const Heard& h) { return VoiceTrouble{h.status.detail}; }

  // It misbehaves in the way of its name on "bad", and serves the next text all the same.
  void loses_one_utterance(const std::string& how, VoiceTrouble expected,
                           std::int64_t skip_us = 0) {
    const auto voice = start(how);
    ASSERT_TRUE(wait_ready(*voice));
    const Heard bad = hear(*voice, "a bad one", skip_us);
    EXPECT_FALSE(bad.status.ok());
    EXPECT_EQ(trouble(bad), expected) << voice->trouble();
    EXPECT_GT(std::string_view(voice->trouble()).size(), 10u);
    ASSERT_TRUE(wait_ready(*voice)) << "it was not started again";
    const Heard good = hear(*voice, "fine");
    EXPECT_TRUE(good.status.ok());
    EXPECT_EQ(good.samples.size(), 400u);
  }

  std::filesystem::path folder_;
};

TEST_F(EspeakProcess, GivesSoundAndEvents) {
  const auto voice = start("good");
  ASSERT_TRUE(wait_ready(*voice));
  EXPECT_EQ(voice->rate_hz(), 22050u);
  const Heard heard = hear(*voice, "hello");
  EXPECT_TRUE(heard.status.ok());
  EXPECT_EQ(heard.samples.size(), 500u);
  ASSERT_EQ(heard.utterance->words().size(), 1u);
  EXPECT_EQ(heard.utterance->words()[0].end_byte, 5u);
  EXPECT_TRUE(heard.utterance->words()[0].stressed());
  ASSERT_EQ(heard.utterance->marks().size(), 1u);
  EXPECT_STREQ(heard.utterance->marks()[0].name.c_str(), "here");
}

TEST_F(EspeakProcess, ACrashCostsOneUtterance) {
  loses_one_utterance("crash", VoiceTrouble::crashed);
}
TEST_F(EspeakProcess, AHangCostsOneUtterance) {
  loses_one_utterance("hang", VoiceTrouble::hung, 3'000'000);
}
TEST_F(EspeakProcess, GarbageCostsOneUtterance) {
  loses_one_utterance("garbage", VoiceTrouble::broken_protocol);
}
TEST_F(EspeakProcess, ALengthBeyondAllBoundsCostsOneUtterance) {
  loses_one_utterance("huge", VoiceTrouble::broken_protocol);
}
TEST_F(EspeakProcess, AWordOutsideTheTextCostsOneUtterance) {
  loses_one_utterance("lies", VoiceTrouble::broken_protocol);
}
TEST_F(EspeakProcess, ATimeBeyondAllBoundsCostsOneUtterance) {
  loses_one_utterance("late", VoiceTrouble::broken_protocol);
}

TEST_F(EspeakProcess, AnUnknownLanguageIsRefusedAndTheVoiceStays) {
  const auto voice = start("mute");
  ASSERT_TRUE(wait_ready(*voice));
  const Heard bad = hear(*voice, "a bad one");
  EXPECT_EQ(bad.status.code, Code::unsupported);
  EXPECT_EQ(trouble(bad), VoiceTrouble::no_language);
  EXPECT_TRUE(voice->ready());
}

TEST_F(EspeakProcess, ANewTextReplacesTheOldOne) {
  const auto voice = start("good");
  ASSERT_TRUE(wait_ready(*voice));
  ASSERT_TRUE(voice->say({.text = "something long"}, monotonic_us()).ok());
  usleep(50'000);  // Its sound is in the socket by now.
  voice->cancel();
  const Heard heard = hear(*voice, "new");
  EXPECT_EQ(heard.samples.size(), 300u);
  EXPECT_EQ(heard.utterance->words()[0].end_byte, 3u);
}

TEST_F(EspeakProcess, AProgramThatDiesAtOnceIsTriedEverMoreSlowly) {
  const auto voice = start("dies");
  auto u = std::make_unique<speech::Utterance>();
  std::size_t count = 0;
  int starts = 0;
  int before = voice->descriptor();
  for (int i = 0; i < 100; ++i) {  // Two seconds: tries after 0.5 and 1.5 s.
    EXPECT_TRUE(voice->pump(monotonic_us(), {}, &count, u.get()).ok());
    if (voice->descriptor() >= 0 && before < 0) ++starts;
    before = voice->descriptor();
    usleep(20'000);
  }
  EXPECT_FALSE(voice->ready());
  EXPECT_LE(starts, 4);
  EXPECT_EQ(voice->say({.text = "x"}, monotonic_us()).code, Code::not_ready);
}

TEST(EspeakProcessFile, AMissingProgramIsOneLine) {
  std::unique_ptr<Voice> voice;
  ErrorLine error;
  EXPECT_EQ(open_espeak_process("/nowhere/caryatid-voice", voice, error).code, Code::io);
  EXPECT_NE(std::string(error.c_str()).find("/nowhere/caryatid-voice"), std::string::npos);
  EXPECT_EQ(std::string(error.c_str()).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace caryatid::platform
