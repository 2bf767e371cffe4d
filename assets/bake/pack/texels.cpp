#include "assets/bake/pack/texels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace caryatid::bake {
namespace {

// IEC 61966-2-1.
float to_linear(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}
float to_srgb(float l) {
  return l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1.0f / 2.4f) - 0.055f;
}

struct Level {
  std::uint32_t width = 0, height = 0;
  bool is_data = false;
  std::vector<Vec4> texels;  // Linear light, colour not premultiplied; or plain numbers.
};

Level from_image(const Image& image) {
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] =
        image.is_data ? static_cast<float>(i) / 255.0f : to_linear(static_cast<float>(i) / 255.0f);
  Level out{image.width, image.height, image.is_data, {}};
  out.texels.resize(std::size_t{image.width} * image.height);
  for (std::size_t i = 0; i < out.texels.size(); ++i) {
    const std::uint8_t* p = &image.rgba[4 * i];
    out.texels[i] = {linear[p[0]], linear[p[1]], linear[p[2]], static_cast<float>(p[3]) / 255.0f};
  }
  return out;
}

Level half(const Level& in) {
  Level out{std::max(in.width / 2, 1u), std::max(in.height / 2, 1u), in.is_data, {}};
  out.texels.resize(std::size_t{out.width} * out.height);
  for (std::uint32_t y = 0; y < out.height; ++y)
    for (std::uint32_t x = 0; x < out.width; ++x) {
      Vec3 weighted{0}, plain{0};
      float alpha = 0.0f;
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t sx = std::min(2 * x + i % 2, in.width - 1);
        const std::uint32_t sy = std::min(2 * y + i / 2, in.height - 1);
        const Vec4& s = in.texels[std::size_t{sy} * in.width + sx];
        weighted += s.w * Vec3(s);
        plain += Vec3(s);
        alpha += s.w;
      }
      const Vec3 color = alpha > 1e-4f && !in.is_data ? weighted / alpha : 0.25f * plain;
      out.texels[std::size_t{y} * out.width + x] = Vec4(color, 0.25f * alpha);
    }
  return out;
}

// Quantises a level row by row, alternately rightwards and leftwards.
void append_quantised(const Level& level, const std::array<int, 4>& bits,
                      std::vector<std::byte>* out) {
  const std::uint32_t w = level.width;
  std::vector<Vec4> error(w + 2, Vec4{0}), next(w + 2, Vec4{0});
  std::vector<std::uint16_t> row(w);
  for (std::uint32_t y = 0; y < level.height; ++y) {
    std::fill(next.begin(), next.end(), Vec4{0});
    const bool rightwards = y % 2 == 0;
    for (std::uint32_t i = 0; i < w; ++i) {
      const std::uint32_t x = rightwards ? i : w - 1 - i;
      const Vec4& l = level.texels[std::size_t{y} * w + x];
      const Vec4 coded = level.is_data ? l : Vec4{to_srgb(l.x), to_srgb(l.y), to_srgb(l.z), l.w};
      const Vec4 wanted = coded + error[x + 1];
      std::uint32_t texel = 0;
      Vec4 rest{0};
      for (int c = 0; c < 4; ++c) {
        if (bits[static_cast<std::size_t>(c)] == 0) continue;
        const auto top = static_cast<float>((1 << bits[static_cast<std::size_t>(c)]) - 1);
        const float q = std::clamp(std::round(wanted[c] * top), 0.0f, top);
        rest[c] = wanted[c] - q / top;
        texel = texel << bits[static_cast<std::size_t>(c)] | static_cast<std::uint32_t>(q);
      }
      row[x] = static_cast<std::uint16_t>(texel);
      const std::uint32_t ahead = rightwards ? x + 2 : x, behind = rightwards ? x : x + 2;
      error[ahead] += rest * (7.0f / 16.0f);
      next[behind] += rest * (3.0f / 16.0f);
      next[x + 1] += rest * (5.0f / 16.0f);
      next[ahead] += rest * (1.0f / 16.0f);
    }
    std::swap(error, next);
    for (const std::uint16_t texel : row) {
      out->push_back(static_cast<std::byte>(texel & 0xFF));
      out->push_back(static_cast<std::byte>(texel >> 8));
    }
  }
}

}  // namespace

std::vector<std::byte> make_texels(const Image& image, std::uint32_t* level_count) {
  const std::array<int, 4> bits =
      image.has_alpha ? std::array<int, 4>{4, 4, 4, 4} : std::array<int, 4>{5, 6, 5, 0};
  std::vector<std::byte> out;
  Level level = from_image(image);
  *level_count = 1;
  append_quantised(level, bits, &out);
  while (level.width > 1 || level.height > 1) {
    level = half(level);
    append_quantised(level, bits, &out);
    ++*level_count;
  }
  return out;
}

std::uint32_t mip_bytes(std::uint32_t width, std::uint32_t height, std::uint32_t first,
                        std::uint32_t count) {
  std::uint32_t bytes = 0;
  for (std::uint32_t level = first; level < first + count; ++level)
    bytes += 2 * std::max(width >> level, 1u) * std::max(height >> level, 1u);
  return bytes;
}

}  // namespace caryatid::bake
