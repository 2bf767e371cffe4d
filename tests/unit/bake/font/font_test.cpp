// The font pack, baked from the fonts of the Debian package that cross/host.sh installs.
#include "assets/bake/font/font.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/pack/font.h"

namespace caryatid::bake {
namespace {

const std::string kSans = "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf";

class FontPack : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kSans)) GTEST_SKIP() << "no " << kSans;
    FontRequest request;
    request.files = {kSans};
    bytes_ = bake_font(request, &report_);
  }
  std::vector<std::byte> bytes_;
  FontReport report_;
};

TEST_F(FontPack, HoldsEveryGlyphInsideAndOutsideOfItsEdge) {
  const auto font = pack::read_font(bytes_);
  ASSERT_TRUE(font.ok());
  EXPECT_GT(report_.code_points, 700u);  // Latin, Greek with polytonic, Cyrillic.
  const pack::FontHeader& h = *font.value.header;
  for (const pack::FontGlyph& g : font.value.glyphs) {
    if (g.width == 0) continue;
    int lowest = 255, highest = 0;
    for (int y = g.y; y < g.y + g.height; ++y)
      for (int x = g.x; x < g.x + g.width; ++x) {
        const int texel = static_cast<int>(
            font.value
                .atlas[static_cast<std::size_t>(y) * h.atlas_width + static_cast<std::size_t>(x)]);
        lowest = std::min(lowest, texel);
        highest = std::max(highest, texel);
        // The margin is far enough out that a letter's outline is never cut.
        EXPECT_TRUE((x != g.x && y != g.y) || texel < 24) << g.glyph_id;
      }
    EXPECT_LT(lowest, 24);
    EXPECT_GT(highest, 128);
  }
}

TEST_F(FontPack, EveryDamageIsRefused) {
  using pack::FontRefusal;
  const auto refusal = [](std::span<const std::byte> bytes) {
    return static_cast<FontRefusal>(pack::read_font(bytes).status.detail);
  };
  EXPECT_EQ(refusal(std::span(bytes_).first(20)), FontRefusal::too_short);
  EXPECT_EQ(refusal(std::span(bytes_).first(bytes_.size() - 4)), FontRefusal::too_short);
  for (std::size_t at = 0; at < bytes_.size(); at += at < 40 ? 1 : 4099) {
    if (at >= 20 && at < 40) continue;  // Sizes; checked for sense below.
    bytes_[at] ^= std::byte{0x20};
    EXPECT_NE(refusal(bytes_), FontRefusal::none) << at;
    bytes_[at] ^= std::byte{0x20};
  }
  EXPECT_EQ(refusal(bytes_), FontRefusal::none);
  bytes_[24] ^= std::byte{1};  // An atlas of 1025 texels a row.
  EXPECT_EQ(refusal(bytes_), FontRefusal::ranges);
}

TEST(BakeFont, WhatIsNoFontIsNamed) {
  FontRequest request;
  request.files = {"/nowhere.ttf"};
  FontReport report;
  EXPECT_THROW(bake_font(request, &report), std::runtime_error);
  request.files.clear();
  EXPECT_THROW(bake_font(request, &report), std::runtime_error);
}

}  // namespace
}  // namespace caryatid::bake
