#include "firmware-app/stream_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/stream/fba_encoder.h"

namespace caryatid::app {
namespace {

// Jaw opening by 4 units a frame, at 10 frames a second.
std::vector<char> jaw_stream(std::size_t frames) {
  stream::FbaSettings settings;
  settings.rate = {10, 0, false};
  settings.fap_mask.set(3);
  std::vector<stream::ModelNode> nodes(256);
  stream::FbaEncoder encoder(settings, nodes);
  std::vector<std::byte> bytes(1 << 14);
  stream::BitWriter writer(bytes);
  EXPECT_TRUE(encoder.begin(&writer).ok());
  for (std::size_t i = 0; i < frames; ++i) {
    face::FapFrame face;
    face.set(3, 4.0f * static_cast<float>(i));
    stream::FbaPlaneInput plane;
    plane.face = &face;
    EXPECT_TRUE(encoder.encode(plane, &writer).ok());
  }
  EXPECT_TRUE(encoder.finish(&writer).ok());
  const char* first = reinterpret_cast<const char*>(bytes.data());
  return {first, first + writer.size_bytes()};
}

struct Place {
  std::string path = (std::filesystem::path(::testing::TempDir()) / "stream_file_test").string();
  Place() { std::filesystem::remove(path); }
  ~Place() { std::filesystem::remove(path); }
  void write(const std::vector<char>& bytes) const {
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
};

TEST(StreamFile, PlaysAFileAndStartsOver) {
  const Place place;
  place.write(jaw_stream(10));
  StreamFile file;
  std::string error;
  ASSERT_TRUE(file.open(place.path, &error)) << error;
  file.seek(0.0);
  file.seek(0.55);
  ASSERT_NE(file.faps(), nullptr);
  EXPECT_EQ(file.baps(), nullptr);
  EXPECT_EQ(file.faps()->get(3), 20.0f);
  file.seek(0.98);  // The last frame is held for its time.
  EXPECT_EQ(file.faps()->get(3), 36.0f);
  file.seek(1.0);
  EXPECT_EQ(file.faps()->get(3), 0.0f);
  file.seek(1.25);
  EXPECT_EQ(file.faps()->get(3), 8.0f);
}

TEST(StreamFile, PlaysAPipeWhileItArrives) {
  const Place place;
  ASSERT_EQ(::mkfifo(place.path.c_str(), 0600), 0);
  StreamFile file;
  std::string error;
  ASSERT_TRUE(file.open(place.path, &error)) << error;
  file.seek(5.0);
  EXPECT_EQ(file.faps(), nullptr);  // Nothing has come.
  const std::vector<char> bytes = jaw_stream(10);
  std::ofstream writer(place.path, std::ios::binary);
  writer.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  writer.flush();
  file.seek(6.0);
  ASSERT_NE(file.faps(), nullptr);
  EXPECT_EQ(file.faps()->get(3), 0.0f);
  file.seek(6.31);
  EXPECT_EQ(file.faps()->get(3), 12.0f);
  file.seek(60.0);  // The end holds.
  EXPECT_EQ(file.faps()->get(3), 36.0f);
}

TEST(StreamFile, RefusesWhatIsNoStream) {
  const Place place;
  std::string error;
  {
    StreamFile file;
    EXPECT_FALSE(file.open(place.path, &error));
    EXPECT_NE(error.find(place.path + ": "), std::string::npos);
  }
  place.write(std::vector<char>(3000, 'x'));
  StreamFile file;
  EXPECT_FALSE(file.open(place.path, &error));
  EXPECT_NE(error.find("no FBA object start code"), std::string::npos) << error;
}

}  // namespace
}  // namespace caryatid::app
