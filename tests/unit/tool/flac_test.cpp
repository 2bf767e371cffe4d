// Recordings in FLAC, made here by libFLAC's encoder.
#include "assets/tool/flac.h"

#include <FLAC/stream_encoder.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace caryatid::tool {
namespace {

class Flac : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  // Sample i of channel c is value(i, c).
  template <class Value>
  void write(unsigned channels, unsigned bits, unsigned rate_hz, std::size_t count, Value value) {
    FLAC__StreamEncoder* encoder = FLAC__stream_encoder_new();
    FLAC__stream_encoder_set_channels(encoder, channels);
    FLAC__stream_encoder_set_bits_per_sample(encoder, bits);
    FLAC__stream_encoder_set_sample_rate(encoder, rate_hz);
    ASSERT_EQ(FLAC__stream_encoder_init_file(encoder, path_.c_str(), nullptr, nullptr),
              FLAC__STREAM_ENCODER_INIT_STATUS_OK);
    std::vector<FLAC__int32> samples;
    for (std::size_t i = 0; i < count; ++i)
      for (unsigned c = 0; c < channels; ++c) samples.push_back(value(static_cast<int>(i), c));
    EXPECT_TRUE(FLAC__stream_encoder_process_interleaved(encoder, samples.data(),
                                                         static_cast<unsigned>(count)));
    EXPECT_TRUE(FLAC__stream_encoder_finish(encoder));
    FLAC__stream_encoder_delete(encoder);
  }
  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("caryatid-flac-" + std::to_string(getpid()) + ".flac"))
                          .string();
};

TEST_F(Flac, ComesBackSampleForSample) {
  const auto value = [](int i, unsigned) { return (i * 37) % 20000 - 10000; };
  write(1, 16, 22050, 9000, value);
  const Spoken s = read_flac(path_);
  EXPECT_EQ(s.rate_hz, 22050u);
  ASSERT_EQ(s.samples.size(), 9000u);
  for (int i = 0; i < 9000; ++i) ASSERT_EQ(s.samples[std::size_t(i)], value(i, 0)) << i;
  EXPECT_EQ(s.end_ms, 9000 * 1000 / 22050);
}

TEST_F(Flac, TwoChannelsAreMixedAndOtherDepthsScaled) {
  write(2, 24, 48000, 5000, [](int i, unsigned c) { return 256 * (c == 0 ? i : 3 * i); });
  const Spoken s = read_flac(path_);
  EXPECT_EQ(s.rate_hz, 48000u);
  ASSERT_EQ(s.samples.size(), 5000u);
  for (int i = 0; i < 5000; ++i) ASSERT_NEAR(s.samples[std::size_t(i)], 2 * i, 1) << i;
}

TEST_F(Flac, IsKnownByItsFirstBytes) {
  write(1, 16, 16000, 1600, [](int, unsigned) { return 123; });
  EXPECT_EQ(read_recording(path_).samples.size(), 1600u);
}

TEST_F(Flac, DamagedAndMissingFilesAreOneLine) {
  write(1, 16, 22050, 20000, [](int i, unsigned) { return (i * 7919) % 30000 - 15000; });
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  EXPECT_THROW((void)read_flac(path_), std::runtime_error);
  std::ofstream(path_, std::ios::binary) << "fLaC and nothing of it";
  EXPECT_THROW((void)read_flac(path_), std::runtime_error);
  EXPECT_THROW((void)read_flac("/nowhere/a.flac"), std::runtime_error);
}

}  // namespace
}  // namespace caryatid::tool
