#include "assets/bake/pack/texels.h"

#include <gtest/gtest.h>

#include "assets/bake/model.h"

namespace caryatid::bake {
namespace {

// 16-bit texels of all levels.
std::vector<unsigned> texels_of(const Image& image) {
  std::uint32_t levels = 0;
  const std::vector<std::byte> bytes = make_texels(image, &levels);
  std::vector<unsigned> out;
  for (std::size_t i = 0; i < bytes.size(); i += 2)
    out.push_back(static_cast<unsigned>(bytes[i]) | static_cast<unsigned>(bytes[i + 1]) << 8);
  return out;
}

// Level red beside an alpha that is 0 in one half and 1 in the other.
Image half_clear(bool is_data) {
  Image image{"x", 8, 8, {}, true, is_data};
  for (int i = 0; i < 64; ++i)
    for (const int v : {i % 2 == 0 ? 255 : 0, 136, 136, i % 2 == 0 ? 255 : 0})
      image.rgba.push_back(static_cast<std::uint8_t>(v));
  return image;
}

TEST(Texels, DataIsAveragedAsItIs) {
  const std::vector<unsigned> texels = texels_of(half_clear(true));
  const unsigned red = texels.back() >> 12, green = texels.back() >> 8 & 15;
  EXPECT_NEAR(red, 7.5, 1.0);
  EXPECT_EQ(green, 8u);
}

TEST(Texels, ColoursAreWeighedByAlpha) {
  const std::vector<unsigned> texels = texels_of(half_clear(false));
  EXPECT_EQ(texels.back() >> 12, 15u);
}

TEST(Texels, LevelDataIsLevelAtEverySize) {
  Image image{"x", 16, 16, std::vector<std::uint8_t>(4 * 16 * 16, 136), true, true};
  for (const unsigned t : texels_of(image)) EXPECT_EQ(t, 0x8888u);
}

}  // namespace
}  // namespace caryatid::bake
