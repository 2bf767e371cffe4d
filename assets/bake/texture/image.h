#pragma once
// Images while they are made: reading, writing, sampling. Pixels are sRGB bytes, RGBA, first row on
// top (bake::Image). Errors: std::runtime_error with one line naming the file.
#include <filesystem>

#include "assets/bake/model.h"

namespace caryatid::bake {

Image read_image(const std::filesystem::path& file);  // PNG, JPEG; name = file's stem.
void write_png(const Image& image, const std::filesystem::path& file);

float srgb_to_linear(float c);
float linear_to_srgb(float c);

// Floats for work in linear light. Alpha is linear already.
struct LinearImage {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec4> texel;

  LinearImage() = default;
  LinearImage(std::uint32_t w, std::uint32_t h, Vec4 fill)
      : width(w), height(h), texel(std::size_t{w} * h, fill) {}
  Vec4& at(std::uint32_t x, std::uint32_t y) { return texel[std::size_t{y} * width + x]; }
  const Vec4& at(std::uint32_t x, std::uint32_t y) const {
    return texel[std::size_t{y} * width + x];
  }
};
LinearImage to_linear(const Image& image);
Image to_srgb(const LinearImage& image, std::string name);

// uv in 0..1, v downwards; borders clamp. Bicubic (Catmull-Rom) is for enlarging.
Vec4 sample_bilinear(const LinearImage& image, Vec2 uv);
Vec4 sample_bicubic(const LinearImage& image, Vec2 uv);

// Any size to any smaller one: box filter; colours weighted by alpha.
LinearImage resize(const LinearImage& image, std::uint32_t width, std::uint32_t height);

// Brightness of every texel becomes mean * (brightness / mean)^contrast; hues stay.
void set_contrast(LinearImage& image, float contrast);

// Gives texels with alpha less than `below` the colour of their nearest opaque neighbours, so that
// filtering and mip levels do not pull a dark or bright rim into the edge of hair.
void bleed_alpha(LinearImage& image, float below);

}  // namespace caryatid::bake
