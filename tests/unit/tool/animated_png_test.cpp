// Animated PNGs are read back chunk by chunk, as a browser does.
#include "assets/tool/animated_png.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace caryatid::tool {
namespace {

std::uint32_t number(const std::string& bytes, std::size_t at, std::size_t size = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

struct Animation {
  std::uint32_t width = 0, height = 0, promised = 0, delay_ms = 0;
  std::vector<Picture> frames;
};

// Draws a frame's indices over what is there; index 255 is transparent.
void draw(const std::string& packed, const std::string& palette, Picture* io) {
  std::string rows((io->width + 1) * io->height, '\0');
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  ASSERT_EQ(size, rows.size());
  for (std::size_t y = 0; y < io->height; ++y)
    for (std::size_t x = 0; x < io->width; ++x) {
      const auto index = static_cast<unsigned char>(rows[y * (io->width + 1) + 1 + x]);
      for (std::size_t c = 0; c < 3 && index != 255; ++c)
        io->rgb[3 * (y * io->width + x) + c] =
            static_cast<std::uint8_t>(palette[std::size_t{3} * index + c]);
    }
}

Animation read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  Animation out;
  Picture shown;
  std::string palette;
  std::uint32_t sequence = 0;
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1A\n");
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::uint32_t size = number(bytes, at);
    const std::string name = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, size);
    const std::string body = name + data;
    EXPECT_EQ(number(bytes, at + 8 + size),
              crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size())))
        << name;
    if (name == "IHDR") shown = Picture(out.width = number(data, 0), out.height = number(data, 4));
    if (name == "acTL") out.promised = number(data, 0);
    if (name == "PLTE") palette = data;
    if (name == "fcTL" || name == "fdAT") {
      EXPECT_EQ(number(data, 0), sequence++);
    }
    if (name == "fcTL") out.delay_ms = 1000 * number(data, 20, 2) / number(data, 22, 2);
    if (name == "IDAT" || name == "fdAT") {
      draw(name == "IDAT" ? data : data.substr(4), palette, &shown);
      out.frames.push_back(shown);
    }
    at += 12 + size;
  }
  return out;
}

class AnimatedPng : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("caryatid-apng-" + std::to_string(getpid()) + ".png"))
                          .string();
};

TEST_F(AnimatedPng, EveryFrameComesBack) {
  std::vector<Picture> frames;
  for (std::uint32_t f = 0; f < 5; ++f) {
    Picture p(20, 10, 30);
    for (std::size_t y = 0; y < 4; ++y)  // A red box that moves over grey.
      for (std::size_t x = 2 * f; x < 2 * f + 4; ++x) p.rgb[3 * (y * 20 + x)] = 240;
    frames.push_back(p);
  }
  write_animated_png(frames, 80, path_);
  const Animation a = read(path_);
  EXPECT_EQ(a.width, 20u);
  EXPECT_EQ(a.height, 10u);
  EXPECT_EQ(a.promised, 5u);
  EXPECT_EQ(a.delay_ms, 80u);
  ASSERT_EQ(a.frames.size(), frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (std::size_t i = 0; i < frames[f].rgb.size(); ++i)
      ASSERT_NEAR(a.frames[f].rgb[i], frames[f].rgb[i], 8) << f << " at " << i;
}

TEST_F(AnimatedPng, WhatStaysCostsNextToNothing) {
  Picture noise(64, 64);
  for (std::size_t i = 0; i < noise.rgb.size(); ++i)
    noise.rgb[i] = static_cast<std::uint8_t>(i * 2654435761u >> 24);
  write_animated_png({noise}, 50, path_);
  const auto one = std::filesystem::file_size(path_);
  write_animated_png(std::vector<Picture>(10, noise), 50, path_);
  EXPECT_LT(std::filesystem::file_size(path_), one + 9 * 120);
}

TEST_F(AnimatedPng, NothingAndNowhereAreRefused) {
  EXPECT_THROW(write_animated_png({}, 50, path_), std::runtime_error);
  EXPECT_THROW(write_animated_png({Picture(4, 4)}, 50, "/nowhere/x.png"), std::runtime_error);
}

}  // namespace
}  // namespace caryatid::tool
