// The audio backends: positions, volume, xruns, a device that goes and comes back.
#include "platform/audio/audio.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "platform/audio/wav.h"
#include "platform/clock/clock.h"
#include "tests/unit/platform/audio/fake_alsa.h"

namespace caryatid::platform {
namespace {

std::unique_ptr<Audio> open(const std::string& kind, bool lockstep = false) {
  std::unique_ptr<Audio> audio;
  ErrorLine error;
  EXPECT_TRUE(open_audio({.kind = kind, .lockstep = lockstep}, audio, error).ok()) << error.c_str();
  return audio;
}

std::vector<std::int16_t> tone(std::size_t samples, std::int16_t value = 1000) {
  return std::vector<std::int16_t>(samples, value);
}

TEST(NullAudio, IsHeardAtThePaceOfTheGivenTime) {
  const auto audio = open("null", true);
  audio->update(0);
  EXPECT_EQ(audio->write(tone(22050)), 22050u);
  EXPECT_EQ(audio->heard(0), 0);
  EXPECT_EQ(audio->heard(500'000), 11025);
  EXPECT_EQ(audio->heard(5'000'000), 22050);  // Never more than was written.
}

TEST(NullAudio, ARingThatRunsDryIsAnUnderrunUnlessItWasTheEnd) {
  const auto audio = open("null", true);
  audio->update(0);
  (void)audio->write(tone(2205));
  audio->update(200'000);
  EXPECT_EQ(audio->counts().underruns, 1u);
  audio->flush();
  (void)audio->write(tone(2205));
  audio->finish();
  audio->update(500'000);
  EXPECT_EQ(audio->counts().underruns, 1u);
}

TEST(NullAudio, FlushForgetsAndStartsAtZero) {
  const auto audio = open("null", true);
  audio->update(0);
  (void)audio->write(tone(22050));
  EXPECT_GT(audio->heard(100'000), 0);
  audio->flush();
  EXPECT_EQ(audio->heard(200'000), 0);
  (void)audio->write(tone(100));
  EXPECT_EQ(audio->heard(300'000), 100);
}

class FileAudio : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = (std::filesystem::temp_directory_path() /
             ("caryatid-audio-" + std::to_string(getpid()) + ".wav"))
                .string();
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::vector<std::int16_t> samples() const {
    const std::string b = bytes();
    WavFormat format;
    EXPECT_TRUE(parse_wav(std::as_bytes(std::span(b)), b.size(), &format).ok());
    std::vector<std::int16_t> out(static_cast<std::size_t>(format.frames));
    std::memcpy(out.data(), b.data() + format.data_offset, 2 * out.size());
    return out;
  }
  std::string path_;
};

TEST_F(FileAudio, HoldsSilenceAndSoundAtTheirTimes) {
  {
    const auto audio = open("file:" + path_, true);
    audio->update(0);
    audio->update(100'000);
    (void)audio->write(tone(441));
    audio->finish();
    audio->update(200'000);
  }
  const auto s = samples();
  ASSERT_EQ(s.size(), 4410u);
  EXPECT_EQ(s[2204], 0);
  EXPECT_EQ(s[2205], 1000);
  EXPECT_EQ(s[2205 + 440], 1000);
  EXPECT_EQ(s[2205 + 441], 0);
}

TEST_F(FileAudio, SameCallsSameBytes) {
  std::string before;
  for (int run = 0; run < 2; ++run) {
    {
      const auto audio = open("file:" + path_, true);
      for (int f = 0; f < 30; ++f) {
        audio->update(f * 33'333);
        (void)audio->write(tone(static_cast<std::size_t>(100 * f), static_cast<std::int16_t>(f)));
      }
    }
    if (run == 0) before = bytes();
  }
  EXPECT_EQ(bytes(), before);
}

TEST_F(FileAudio, VolumeRampsWithoutAClick) {
  {
    const auto audio = open("file:" + path_, true);
    audio->update(0);
    (void)audio->write(tone(22050, 10000));
    audio->set_volume(0.0f);
    audio->update(1'000'000);
  }
  const auto s = samples();
  for (std::size_t i = 1; i < s.size(); ++i) ASSERT_LE(std::abs(s[i] - s[i - 1]), 20) << i;
  EXPECT_EQ(s[1200], 0);  // 54 ms later.
}

TEST_F(FileAudio, APlaceThatCantBeWrittenIsOneLine) {
  std::unique_ptr<Audio> audio;
  ErrorLine error;
  EXPECT_EQ(open_audio({.kind = "file:/nowhere/x.wav"}, audio, error).code, Code::io);
  EXPECT_NE(std::string(error.c_str()).find("/nowhere/x.wav"), std::string::npos);
}

TEST(Audio, AnUnknownKindIsOneLine) {
  std::unique_ptr<Audio> audio;
  ErrorLine error;
  EXPECT_EQ(open_audio({.kind = "gramophone"}, audio, error).code, Code::unsupported);
  EXPECT_NE(std::string(error.c_str()).find("gramophone"), std::string::npos);
}

class AlsaAudio : public ::testing::Test {
 protected:
  void SetUp() override { FakeAlsa::get().reset(); }

  static bool within(int ms, const std::function<bool()>& is_true) {
    for (int i = 0; i < ms; i += 5) {
      if (is_true()) return true;
      usleep(5000);
    }
    return is_true();
  }
  static std::size_t count_of(std::int16_t value) {
    const std::lock_guard lock(FakeAlsa::get().mutex);
    const auto& played = FakeAlsa::get().played;
    return static_cast<std::size_t>(std::count(played.begin(), played.end(), value));
  }
};

TEST_F(AlsaAudio, WhatIsHeardFollowsTheDevice) {
  const auto audio = open("alsa");
  usleep(100'000);  // It runs on silence.
  audio->flush();
  (void)audio->write(tone(11025));
  audio->finish();
  const std::int64_t start_us = monotonic_us();
  std::int64_t before = 0;
  while (monotonic_us() - start_us < 400'000) {
    const std::int64_t now_us = monotonic_us();
    const std::int64_t heard = audio->heard(now_us);
    ASSERT_GE(heard, before);
    before = heard;
    // Sound that is written now is heard when the device's 40 ms are over, then at its rate. The
    // machine that tests may be busy: 60 ms more.
    const double expected_ms = static_cast<double>(now_us - start_us) * 1e-3;
    EXPECT_LE(static_cast<double>(heard) * 1000.0 / 22050.0, expected_ms + 5.0);
    usleep(3000);
  }
  EXPECT_GT(before, 22050 * 250 / 1000);
  EXPECT_TRUE(within(2000, [&] { return audio->heard(monotonic_us()) == 11025; }));
  EXPECT_EQ(count_of(1000), 11025u);
  EXPECT_EQ(audio->counts().underruns, 0u);
}

TEST_F(AlsaAudio, AnXrunIsCountedAndNothingIsLost) {
  const auto audio = open("alsa");
  (void)audio->write(tone(8000));
  audio->finish();
  FakeAlsa::get().underruns_due = 1;
  EXPECT_TRUE(within(2000, [&] { return audio->heard(monotonic_us()) == 8000; }));
  EXPECT_EQ(count_of(1000), 8000u);
  EXPECT_GE(audio->counts().underruns, 1u);
  EXPECT_GE(FakeAlsa::get().recovers.load(), 1);
}

TEST_F(AlsaAudio, WithoutItsDeviceTheShowGoesOnAndTheDeviceComesBack) {
  const auto audio = open("alsa");
  (void)audio->write(tone(22050));
  audio->finish();
  usleep(100'000);
  FakeAlsa::get().plugged = false;
  EXPECT_TRUE(within(1000, [&] { return !audio->present(); }));
  EXPECT_EQ(audio->counts().losses, 1u);
  EXPECT_TRUE(within(3000, [&] { return audio->heard(monotonic_us()) == 22050; }));
  FakeAlsa::get().plugged = true;
  EXPECT_TRUE(within(5000, [&] { return audio->present(); }));
  audio->flush();
  (void)audio->write(tone(2000, 77));
  audio->finish();
  EXPECT_TRUE(within(2000, [&] { return count_of(77) == 2000; }));
}

TEST_F(AlsaAudio, ADeviceThatTakesNothingIsLost) {
  const auto audio = open("alsa");
  FakeAlsa::get().stuck = true;
  EXPECT_TRUE(within(3000, [&] { return !audio->present(); }));
}

TEST_F(AlsaAudio, ADeviceOfTwoChannelsPlaysMono) {
  FakeAlsa::get().mono = false;
  const auto audio = open("alsa");
  (void)audio->write(tone(3000, 55));
  audio->finish();
  EXPECT_TRUE(within(2000, [&] { return count_of(55) == 3000; }));
}

TEST_F(AlsaAudio, AFlushSilencesWithinTheDevicesBuffer) {
  const auto audio = open("alsa");
  (void)audio->write(tone(22050, 99));
  usleep(150'000);
  audio->flush();
  usleep(100'000);
  const std::size_t now = count_of(99);
  EXPECT_LT(now, 22050u / 2);
  usleep(100'000);
  EXPECT_EQ(count_of(99), now);
  EXPECT_EQ(audio->heard(monotonic_us()), 0);
}

TEST_F(AlsaAudio, AutoTakesNullWhereThereIsNoDevice) {
  FakeAlsa::get().plugged = false;
  const auto audio = open("auto");
  (void)audio->heard(0);
  (void)audio->write(tone(100));
  EXPECT_EQ(audio->heard(1'000'000), 100);
}

TEST_F(AlsaAudio, HasNoPlaceUnderAVirtualClock) {
  std::unique_ptr<Audio> audio;
  ErrorLine error;
  EXPECT_EQ(open_audio({.kind = "alsa", .lockstep = true}, audio, error).code, Code::unsupported);
}

}  // namespace
}  // namespace caryatid::platform
