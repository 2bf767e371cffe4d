// What lies over the scene: letters, boxes and pictures where they were put, nothing elsewhere, at
// every turn of the display.
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/golden/studio.h"

namespace caryatid::golden {
namespace {

class Overlay : public Studio {
 protected:
  void start() {
    std::ifstream in(std::string(CARYATID_SOURCE_DIR) + "/firmware-app/builtin_font.pack",
                     std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
    const auto font = pack::read_font(std::as_bytes(std::span(bytes_)));
    ASSERT_TRUE(font.ok());
    font_ = font.value;
    open();
    ASSERT_TRUE(renderer_->load_font(font_).ok());
    plain_ = shoot();
  }
  Image with(std::uint32_t turn = 0) {
    scene::Overlay& o = pack_.edit_list().overlay;
    o.quads = quads_.span();
    ++o.version;
    o.picture = 0;
    o.width = turn % 180 == 0 ? kWidth : kHeight;
    o.height = turn % 180 == 0 ? kHeight : kWidth;
    o.turn_degrees = turn;
    return shoot();
  }
  // Pixels that differ from the scene alone: their bounding box, and how many.
  struct Change {
    scene::Box box{1e9f, 1e9f, 0, 0};
    int pixels = 0;
  };
  Change change(const Image& image) const {
    Change c;
    for (std::uint32_t y = 0; y < image.height; ++y)
      for (std::uint32_t x = 0; x < image.width; ++x) {
        const std::size_t at = 3 * (std::size_t{y} * image.width + x);
        int difference = 0;
        for (std::size_t i = 0; i < 3; ++i)
          difference = std::max(difference, std::abs(image.rgb[at + i] - plain_.rgb[at + i]));
        if (difference < 24) continue;
        ++c.pixels;
        c.box = {std::min(c.box.x0, float(x)), std::min(c.box.y0, float(y)),
                 std::max(c.box.x1, float(x + 1)), std::max(c.box.y1, float(y + 1))};
      }
    return c;
  }
  void expect_at(const Change& c, const scene::Box& box) const {
    EXPECT_NEAR(c.box.x0, box.x0, 1.5f);
    EXPECT_NEAR(c.box.y0, box.y0, 1.5f);
    EXPECT_NEAR(c.box.x1, box.x1, 1.5f);
    EXPECT_NEAR(c.box.y1, box.y1, 1.5f);
  }

  std::vector<char> bytes_;
  pack::FontView font_;
  FixedVector<scene::OverlayQuad, kMaxOverlayQuads> quads_;
  Image plain_;
};

TEST_F(Overlay, ABoxStandsWhereItWasPutAtEveryTurn) {
  start();
  scene::Pen(font_, &quads_).box({20, 10, 100, 60}, 8, {255, 0, 255, 255});
  expect_at(change(with()), {20, 10, 100, 60});
  const float w = kWidth, h = kHeight;
  expect_at(change(with(180)), {w - 100, h - 60, w - 20, h - 10});
  // The visitor's right is the panel's lower or upper side.
  const Change quarter = change(with(90)), other = change(with(270));
  EXPECT_NEAR(quarter.box.width(), 50, 3);
  EXPECT_NEAR(quarter.box.height(), 80, 3);
  expect_at(other,
            {w - quarter.box.x1, h - quarter.box.y1, w - quarter.box.x0, h - quarter.box.y0});
}

TEST_F(Overlay, CornersAreRoundAndSidesAreFull) {
  start();
  scene::Pen(font_, &quads_).box({20, 10, 100, 60}, 16, {255, 0, 255, 255});
  const int full = 80 * 50, cut = static_cast<int>(16 * 16 * (4 - 3.1416));
  EXPECT_NEAR(change(with()).pixels, full - cut, 60);
}

TEST_F(Overlay, LettersAreAsLargeAsAskedFor) {
  start();
  scene::ShapedGlyph glyph{};
  for (std::size_t g = 0; g < font_.glyphs.size(); ++g)  // The widest: some capital.
    if (font_.glyphs[g].height > font_.glyphs[glyph.glyph].height)
      glyph.glyph = static_cast<std::uint16_t>(g);
  scene::Run run;
  run.glyphs = {&glyph, 1};
  for (const float size : {24.0f, 72.0f}) {
    quads_.clear();
    scene::Pen(font_, &quads_)
        .line({&run, 1}, 60, 100, {.size_px = size, .ink = {255, 0, 255, 255}});
    const float margin = 2.0f * static_cast<float>(font_.header->spread_px);
    const float tall = (font_.glyphs[glyph.glyph].height - margin) * size /
                       static_cast<float>(font_.header->em_px);
    EXPECT_NEAR(change(with()).box.height(), tall, 0.12f * tall + 1.0f);
  }
}

TEST_F(Overlay, PicturesShowTheirTexels) {
  start();
  const std::vector<std::uint16_t> magenta(16 * 16, 0xF81F);
  ASSERT_TRUE(renderer_->load_picture(0, 16, 16, magenta).ok());
  scene::Pen(font_, &quads_).picture({30, 30, 90, 70}, 1.0f);
  expect_at(change(with()), {30, 30, 90, 70});
  EXPECT_FALSE(renderer_->load_picture(0, 16, 16, std::span(magenta).first(9)).ok());
  EXPECT_FALSE(renderer_->load_picture(kMaxPictures, 16, 16, magenta).ok());
}

TEST_F(Overlay, NothingIsDrawnWithoutLettersOrQuads) {
  start();
  EXPECT_EQ(change(with()).pixels, 0);
}

}  // namespace
}  // namespace caryatid::golden
