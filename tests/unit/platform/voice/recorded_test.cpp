// Recordings: what is sound plays, what lies is refused with its reason.
#include "platform/voice/recorded/recorded.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "platform/audio/wav.h"

namespace caryatid::platform {
namespace {

class Recorded : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("caryatid-rec-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    put(".wav", wav(22050));
    put(".timing", kTiming);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static constexpr const char* kTiming =
      "caryatid-timing 1\n# a comment\nsentence 0\nword 0 0 5\nphone 0 h\nphone 90 \u02C8e\n"
      "mark 100 wave\nphone 500 l\nend 1000\n";

  static std::string wav(std::uint32_t frames) {
    const auto head = wav_head(22050, frames);
    return std::string(reinterpret_cast<const char*>(head.data()), head.size()) +
           std::string(2 * std::size_t{frames}, '\3');
  }
  void put(const std::string& suffix, const std::string& bytes) {
    std::ofstream(name() + suffix, std::ios::binary) << bytes;
  }
  std::string name() const { return (folder_ / "x").string(); }

  // What say() complains about; empty when it does not.
  std::string complaint() {
    const auto voice = make_recorded();
    const std::string file = name();
    return voice->say({.recording = file}, 0).ok() ? "" : voice->trouble();
  }

  std::filesystem::path folder_;
};

TEST_F(Recorded, PlaysSoundAndEvents) {
  const auto voice = make_recorded();
  const std::string file = name();
  ASSERT_TRUE(voice->say({.recording = file}, 0).ok()) << voice->trouble();
  auto u = std::make_unique<speech::Utterance>();
  std::vector<std::int16_t> piece(700);
  std::size_t total = 0;
  for (int i = 0; i < 100 && !u->finished(); ++i) {
    std::size_t count = 0;
    ASSERT_TRUE(voice->pump(0, piece, &count, u.get()).ok());
    total += count;
  }
  EXPECT_EQ(total, 22050u);
  EXPECT_EQ(u->end_ms(), 1000);
  EXPECT_EQ(u->phones().size(), 3u);
  ASSERT_EQ(u->words().size(), 1u);
  EXPECT_EQ(u->words()[0].stress_ms, 90);
  EXPECT_STREQ(u->marks()[0].name.c_str(), "wave");
}

TEST_F(Recorded, PlaysAgain) {
  const auto voice = make_recorded();
  const std::string file = name();
  auto u = std::make_unique<speech::Utterance>();
  std::vector<std::int16_t> piece(30000);
  std::size_t count = 0;
  for (int i = 0; i < 2; ++i) {
    u->clear();
    ASSERT_TRUE(voice->say({.recording = file}, 0).ok());
    ASSERT_TRUE(voice->pump(0, piece, &count, u.get()).ok());
    EXPECT_EQ(count, 22050u);
    EXPECT_TRUE(u->finished());
  }
}

TEST_F(Recorded, AWavThatLiesAboutItsLengthIsRefused) {
  const auto head = wav_head(22050, 1'000'000);
  put(".wav", std::string(reinterpret_cast<const char*>(head.data()), head.size()) + "short");
  EXPECT_NE(complaint().find("promises more sound than it holds"), std::string::npos)
      << complaint();
}

TEST_F(Recorded, AFileThatIsNoWavIsRefused) {
  put(".wav", "hello");
  EXPECT_NE(complaint().find("is no WAV"), std::string::npos) << complaint();
}

TEST_F(Recorded, AMissingFileIsNamed) {
  std::filesystem::remove(name() + ".wav");
  EXPECT_NE(complaint().find("x.wav"), std::string::npos) << complaint();
}

TEST_F(Recorded, ADamagedTimingNamesItsLine) {
  put(".timing", "caryatid-timing 1\nphone 10 a\nphone x\nend 100\n");
  EXPECT_NE(complaint().find("line 3"), std::string::npos) << complaint();
  put(".timing", "caryatid-timing 1\nphone 10 a\nphone 5 a\nend 100\n");
  EXPECT_NE(complaint().find("line 3"), std::string::npos) << complaint();
  put(".timing", "caryatid-timing 1\nphone 10 a\n");
  EXPECT_NE(complaint().find("line 3"), std::string::npos) << complaint();
  put(".timing", "something else\n");
  EXPECT_NE(complaint().find("line 1"), std::string::npos) << complaint();
  put(".timing", "caryatid-timing 1\n" + std::string(5000, 'x') + "\nend 1\n");
  EXPECT_NE(complaint().find("line 2"), std::string::npos) << complaint();
}

TEST(TimingLine, ReadsWhatTheFormatSays) {
  TimingLine line;
  const auto reads = [&line](std::string_view text) { return parse_timing_line(text, &line); };
  EXPECT_TRUE(reads("word 829 10 15"));
  EXPECT_EQ(line.kind, TimingLine::Kind::word);
  EXPECT_EQ(line.begin_byte, 10u);
  EXPECT_TRUE(reads("phone 5"));  // Silence.
  EXPECT_TRUE(reads(""));
  for (const char* bad : {"word 829 15 10", "word 829 10", "phone -1 a", "phone 99999999 a",
                          "mark 5", "end", "end 5 x", "what 5", "word 1 0 9999999"})
    EXPECT_FALSE(reads(bad)) << bad;
}

TEST(Wav, ReadsItsOwnHead) {
  WavFormat format;
  const auto head = wav_head(48000, 100);
  ASSERT_TRUE(parse_wav(head, 44 + 200, &format).ok());
  EXPECT_EQ(format.rate_hz, 48000u);
  EXPECT_EQ(format.frames, 100u);
  EXPECT_EQ(format.data_offset, 44u);
}

TEST(Wav, EachFaultHasItsReason) {
  const auto refused = [](auto change, std::uint64_t file_bytes = 244) {
    auto head = wav_head(22050, 100);
    change(head);
    WavFormat format;
    return WavRefusal{parse_wav(head, file_bytes, &format).detail};
  };
  EXPECT_EQ(refused([](auto& h) { h[0] = std::byte{'X'}; }), WavRefusal::no_riff);
  EXPECT_EQ(refused([](auto& h) { h[12] = std::byte{'X'}; }), WavRefusal::no_format);
  EXPECT_EQ(refused([](auto& h) { h[36] = std::byte{'X'}; }), WavRefusal::no_data);
  EXPECT_EQ(refused([](auto& h) { h[34] = std::byte{8}; }), WavRefusal::bad_format);
  EXPECT_EQ(refused([](auto& h) { h[22] = std::byte{9}; }), WavRefusal::bad_format);
  EXPECT_EQ(refused([](auto&) {}, 243), WavRefusal::lying_length);
  WavFormat format;
  EXPECT_EQ(WavRefusal{parse_wav({}, 0, &format).detail}, WavRefusal::no_riff);
}

}  // namespace
}  // namespace caryatid::platform
