#include "tests/golden/image.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image.h>
#include <stb_image_write.h>

namespace caryatid::golden {

Difference compare(const Image& a, const Image& b) {
  std::array<std::uint64_t, 256> count{};
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const int d = std::abs(a.rgb[i] - b.rgb[i]);
    ++count[static_cast<std::size_t>(d)];
    sum += d;
  }
  const auto total = static_cast<double>(a.rgb.size());
  Difference out{sum / total, 0};
  double below = 0.0;
  for (int d = 0; d < 256; ++d) {
    below += static_cast<double>(count[static_cast<std::size_t>(d)]);
    if (below >= 0.999 * total) {
      out.percentile_99_9 = d;
      break;
    }
  }
  return out;
}

Image read_png(const std::string& path) {
  int w = 0, h = 0, channels = 0;
  std::uint8_t* data = stbi_load(path.c_str(), &w, &h, &channels, 3);
  if (data == nullptr) return {};
  Image out{static_cast<std::uint32_t>(w), static_cast<std::uint32_t>(h), {}};
  out.rgb.assign(data, data + std::size_t{3} * out.width * out.height);
  stbi_image_free(data);
  return out;
}

bool write_png(const Image& image, const std::string& path) {
  const int w = static_cast<int>(image.width), h = static_cast<int>(image.height);
  return stbi_write_png(path.c_str(), w, h, 3, image.rgb.data(), 3 * w) != 0;
}

void expect_golden(const Image& image, const std::string& name) {
  const std::string truth = std::string(CARYATID_GOLDEN_DIR) + "/" + name + ".png";
  if (const char* update = std::getenv("CARYATID_UPDATE_GOLDEN"); update && *update == '1') {
    ASSERT_TRUE(write_png(image, truth)) << truth;
  }
  const Image golden = read_png(truth);
  ASSERT_EQ(golden.width, image.width) << truth << " is missing or of another size";
  ASSERT_EQ(golden.height, image.height);
  const Difference d = compare(image, golden);
  if (d.mean <= 1.0 && d.percentile_99_9 <= 24) return;
  const std::string seen = std::string(CARYATID_GOLDEN_OUT) + "/" + name + ".png";
  std::filesystem::create_directories(CARYATID_GOLDEN_OUT);
  write_png(image, seen);
  ADD_FAILURE() << name << ": mean error " << d.mean << ", 99.9th percentile " << d.percentile_99_9
                << "; look at " << seen << " beside " << truth;
}

}  // namespace caryatid::golden
