// The real libasound without hardware: its own file, null, rate and route plugins, and a card of
// ours (clocked_pcm.c) that it loads as a plugin and that keeps the time of a sound card.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "platform/audio/audio.h"
#include "platform/clock/clock.h"

namespace caryatid::platform {
namespace {

std::string folder() {
  static const std::string name =
      (std::filesystem::temp_directory_path() / ("caryatid-alsa-" + std::to_string(getpid())))
          .string();
  return name;
}

// libasound reads its configuration once in a process.
class RealAlsa : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::filesystem::create_directories(folder());
    std::ofstream conf(folder() + "/asound.conf");
    const auto file = [](const char* name) { return "file \"" + folder() + "/" + name + "\" "; };
    conf << "pcm_type.caryatid_clock { lib \"" << CARYATID_CLOCKED_PCM << "\" }\n"
         << "pcm.silent { type null }\n"
         << "pcm.filed { type file slave.pcm silent format raw " << file("filed.raw") << "}\n"
         << "pcm.card { type caryatid_clock " << file("card.raw") << "}\n"
         << "pcm.stereo { type caryatid_clock channels 2 " << file("stereo.raw") << "}\n"
         << "pcm.xruns { type caryatid_clock xrun_at 6000 " << file("xruns.raw") << "}\n"
         << "pcm.dies { type caryatid_clock dead_at 8000 " << file("dies.raw") << "}\n"
         << "pcm.leaves { type caryatid_clock gone_at 8000 " << file("leaves.raw") << "}\n"
         << "pcm.fixed { type plug slave { rate 48000 channels 2 format S16 pcm { type "
            "caryatid_clock channels 2 "
         << file("fixed.raw") << "} } }\n";
    conf.close();
    setenv("ALSA_CONFIG_PATH", (folder() + "/asound.conf").c_str(), 1);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder()); }

  static std::unique_ptr<Audio> open(const std::string& device) {
    std::unique_ptr<Audio> audio;
    ErrorLine error;
    EXPECT_TRUE(open_audio({.kind = "alsa:" + device}, audio, error).ok()) << error.c_str();
    return audio;
  }
  static bool within(int ms, const std::function<bool()>& is_true) {
    for (int i = 0; i < ms && !is_true(); i += 5) usleep(5000);
    return is_true();
  }
  static std::vector<std::int16_t> played(const std::string& name) {
    std::ifstream in(folder() + "/" + name, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    std::vector<std::int16_t> out(bytes.size() / 2);
    std::memcpy(out.data(), bytes.data(), 2 * out.size());
    return out;
  }
  static std::vector<std::int16_t> tone(std::size_t samples) {
    std::vector<std::int16_t> out(samples);
    for (std::size_t i = 0; i < samples; ++i)
      out[i] = static_cast<std::int16_t>(
          8000.0 * std::sin(2.0 * std::numbers::pi * 441.0 * static_cast<double>(i) / 22050.0) + 1);
    return out;
  }
  // Plays all of it; waits until it has been heard.
  static void play(Audio& audio, const std::vector<std::int16_t>& sound) {
    audio.flush();
    ASSERT_EQ(audio.write(sound), sound.size());
    audio.finish();
    const auto all = static_cast<std::int64_t>(sound.size());
    EXPECT_TRUE(within(10'000, [&] { return audio.heard(monotonic_us()) == all; }))
        << audio.heard(monotonic_us());
  }
  // Where `sound` lies in what was played, whole and unchanged.
  static bool holds(const std::vector<std::int16_t>& all, const std::vector<std::int16_t>& sound) {
    return std::search(all.begin(), all.end(), sound.begin(), sound.end()) != all.end();
  }
};

TEST_F(RealAlsa, TheFilePluginHoldsWhatWasWritten) {
  const auto sound = tone(11025);
  {
    const auto audio = open("filed");
    ASSERT_TRUE(audio);
    ASSERT_TRUE(audio);
    play(*audio, sound);
    EXPECT_EQ(audio->counts().underruns, 0u);
    EXPECT_EQ(audio->counts().losses, 0u);
  }
  EXPECT_TRUE(holds(played("filed.raw"), sound));
}

// A device that takes everything at once (ALSA's null) must not run away with the sound, nor keep
// a core busy.
TEST_F(RealAlsa, ADeviceWithoutAClockIsPlayedAtThePaceOfSound) {
  const auto audio = open("silent");
  ASSERT_TRUE(audio);
  audio->flush();
  const std::int64_t start_us = monotonic_us();
  ASSERT_EQ(audio->write(tone(22050)), 22050u);
  audio->finish();
  EXPECT_TRUE(within(10'000, [&] { return audio->heard(monotonic_us()) == 22050; }));
  EXPECT_GT(monotonic_us() - start_us, 800'000);
}

TEST_F(RealAlsa, ACardPlaysEverySampleInOrder) {
  const auto sound = tone(11025);
  const auto audio = open("card");
  ASSERT_TRUE(audio);
  play(*audio, sound);
  EXPECT_TRUE(holds(played("card.raw"), sound));
  EXPECT_TRUE(audio->present());
}

TEST_F(RealAlsa, ACardOfTwoChannelsPlaysTheSameOnBoth) {
  const auto sound = tone(5000);
  const auto audio = open("stereo");
  ASSERT_TRUE(audio);
  play(*audio, sound);
  std::vector<std::int16_t> left, right;
  const auto all = played("stereo.raw");
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
    left.push_back(all[i]);
    right.push_back(all[i + 1]);
  }
  EXPECT_TRUE(holds(left, sound));
  EXPECT_EQ(left, right);
}

TEST_F(RealAlsa, AnXrunIsRecoveredFromAndCounted) {
  const auto sound = tone(11025);
  const auto audio = open("xruns");
  ASSERT_TRUE(audio);
  play(*audio, sound);
  EXPECT_GE(audio->counts().underruns, 1u);
  EXPECT_EQ(audio->counts().losses, 0u);
  // What the card held at that moment may be lost; the end is there.
  const std::vector<std::int16_t> end(sound.end() - 2000, sound.end());
  EXPECT_TRUE(holds(played("xruns.raw"), end));
}

TEST_F(RealAlsa, ACardThatLeavesIsLostAndFoundAgain) {
  const auto audio = open("leaves");
  ASSERT_TRUE(audio);
  audio->flush();
  (void)audio->write(tone(22050));
  audio->finish();
  EXPECT_TRUE(within(10'000, [&] { return audio->counts().losses >= 1; }));
  EXPECT_TRUE(within(10'000, [&] { return audio->heard(monotonic_us()) == 22050; }));
  EXPECT_TRUE(within(10'000, [&] { return audio->present(); }));
}

// Nothing but xruns: the real-time thread gives it up in place of trying for ever.
TEST_F(RealAlsa, ACardThatCannotBeRecoveredIsLost) {
  const auto audio = open("dies");
  ASSERT_TRUE(audio);
  audio->flush();
  (void)audio->write(tone(22050));
  audio->finish();
  EXPECT_TRUE(within(10'000, [&] { return audio->counts().losses >= 1; }));
  EXPECT_TRUE(within(10'000, [&] { return audio->heard(monotonic_us()) == 22050; }));
}

TEST_F(RealAlsa, VolumeIsAFactor) {
  const auto audio = open("card");
  ASSERT_TRUE(audio);
  audio->set_volume(0.5f);
  usleep(200'000);
  const std::vector<std::int16_t> loud(8000, 10000);
  play(*audio, loud);
  const auto all = played("card.raw");
  EXPECT_GT(std::count(all.begin(), all.end(), std::int16_t{5000}), 6000);
}

// alsa:plug... in front of a card that has one rate alone, as HDMI often has.
TEST_F(RealAlsa, AnotherRateIsResampledByAlsa) {
  const auto sound = tone(11025);
  const auto audio = open("fixed");
  ASSERT_TRUE(audio);
  play(*audio, sound);
  const auto all = played("fixed.raw");
  std::size_t crossings = 0, loud = 0;
  for (std::size_t i = 2; i + 1 < all.size(); i += 2) {
    crossings += all[i - 2] < 0 && all[i] >= 0;
    loud += std::abs(int{all[i]}) > 2000;
  }
  EXPECT_NEAR(static_cast<double>(crossings), 441.0 / 2.0, 4.0);  // Half a second of 441 Hz.
  EXPECT_GT(loud, 15'000u);                                       // Of 24 000.
}

TEST_F(RealAlsa, AnUnknownDeviceIsOneLineWithAlsasWords) {
  std::unique_ptr<Audio> audio;
  ErrorLine error;
  EXPECT_EQ(open_audio({.kind = "alsa:nothing"}, audio, error).code, Code::io);
  EXPECT_NE(std::string(error.c_str()).find("nothing: No such file"), std::string::npos)
      << error.c_str();
}

}  // namespace
}  // namespace caryatid::platform
