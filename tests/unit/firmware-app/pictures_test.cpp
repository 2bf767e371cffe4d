#include "firmware-app/pictures.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace caryatid::app {
namespace {

std::string file(const std::string& name) {
  std::ifstream in(std::string(CARYATID_SOURCE_DIR) + "/assets/programme/pictures/" + name,
                   std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string refusal(const std::string& bytes) {
  Picture picture;
  std::string error;
  EXPECT_FALSE(decode_picture(bytes, 1024, &picture, &error));
  return error;
}

// The first bytes of a PNG that says to be so large.
std::string png_header(unsigned width, unsigned height) {
  std::string out = "\x89PNG\r\n\x1a\n";
  out += std::string("\0\0\0\rIHDR", 8);
  for (const unsigned n : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(n >> shift);
  return out + std::string("\x08\x02\0\0\0\0\0\0\0", 9) + std::string(64, 'x');
}

TEST(Pictures, PngAndJpegBecomeTextures) {
  for (const char* name : {"map.png", "founder.jpg"}) {
    Picture p;
    std::string error;
    ASSERT_TRUE(decode_picture(file(name), 512, &p, &error)) << name << error;
    EXPECT_EQ(p.texture_width & (p.texture_width - 1), 0);
    EXPECT_LE(p.texture_width, 512);
    EXPECT_EQ(p.texels.size(), std::size_t{p.texture_width} * p.texture_height);
    EXPECT_GT(p.width, 100);
  }
}

TEST(Pictures, BombsAreRefusedBeforeTheyAreDecoded) {
  EXPECT_NE(refusal(png_header(60000, 60000)).find("60000x60000 pixels"), std::string::npos);
  EXPECT_NE(refusal(png_header(8000, 8000)).find("8000x8000 pixels; at most 24 million"),
            std::string::npos);
  EXPECT_NE(refusal(png_header(0xFFFFFFFF, 3)), "");
}

TEST(Pictures, WhatIsNoPictureOrDamagedIsSaid) {
  EXPECT_NE(refusal("").find("no PNG or JPEG"), std::string::npos);
  EXPECT_NE(refusal("GIF89a..........").find("no PNG or JPEG"), std::string::npos);
  EXPECT_NE(refusal(png_header(100, 100)).find("damaged"), std::string::npos);
  const std::string whole = file("map.png");
  EXPECT_NE(refusal(whole.substr(0, whole.size() / 2)).find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace caryatid::app
