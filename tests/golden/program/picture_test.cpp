// Pictures of the built-in face against kept ones, by tolerance: drivers may differ in a bit, not
// in a face. The kept pictures were looked at; CARYATID_GOLDEN_UPDATE=1 writes new ones to look at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/emotion/profiles.h"
#include "tests/golden/program/pixels.h"
#include "tests/golden/program/program.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace caryatid::golden {

Pixels read_png(const std::filesystem::path& file) {
  Pixels p;
  int channels = 0;
  unsigned char* data = stbi_load(file.c_str(), &p.width, &p.height, &channels, 3);
  if (data == nullptr) return p;
  p.rgb.assign(data, data + std::size_t{3} * static_cast<std::size_t>(p.width * p.height));
  stbi_image_free(data);
  return p;
}

namespace {

class Picture : public testing::TestWithParam<const char*> {};

TEST_P(Picture, LooksAsItWasSeen) {
  const std::string emotion = GetParam();
  const auto folder = fresh_folder("picture_" + emotion);
  const auto script =
      write_file(folder / "script", "0 " + emotion + " down\n0.3 " + emotion + " down\n");
  const Outcome run =
      run_program("--pack " + kBuiltin + " --config " + kSource +
                  "/assets/programme/feelings.toml"
                  " --display surfaceless --size 240x240 --lod 100000"
                  " --virtual-clock --duration 1.01 --frames-every 30 --frames-out " +
                  folder.string() + " --script " + script.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto kept = std::filesystem::path(kSource) / "tests/golden/program" / (emotion + ".png");
  const auto made = folder / "frame_00030.png";
  if (std::getenv("CARYATID_GOLDEN_UPDATE") != nullptr)
    std::filesystem::copy_file(made, kept, std::filesystem::copy_options::overwrite_existing);
  const Pixels a = read_png(kept), b = read_png(made);
  ASSERT_EQ(a.rgb.size(), b.rgb.size());
  ASSERT_FALSE(a.rgb.empty());
  std::vector<int> error(a.rgb.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = std::abs(a.rgb[i] - b.rgb[i]);
    mean += error[i] / static_cast<double>(error.size());
  }
  std::sort(error.begin(), error.end());
  EXPECT_LT(mean, 1.0);
  EXPECT_LT(error[error.size() * 999 / 1000], 40);
}

INSTANTIATE_TEST_SUITE_P(Emotions, Picture, testing::Values("joy", "sadness", "surprise", "calm"));

}  // namespace
}  // namespace caryatid::golden
