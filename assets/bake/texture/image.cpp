#include "assets/bake/texture/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "assets/bake/files/files.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#include <stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace caryatid::bake {
namespace {

// Clamped texel fetch.
const Vec4& fetch(const LinearImage& image, int x, int y) {
  return image.at(static_cast<std::uint32_t>(std::clamp(x, 0, static_cast<int>(image.width) - 1)),
                  static_cast<std::uint32_t>(std::clamp(y, 0, static_cast<int>(image.height) - 1)));
}

std::array<float, 4> catmull_rom(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {-0.5f * t3 + t2 - 0.5f * t, 1.5f * t3 - 2.5f * t2 + 1.0f,
          -1.5f * t3 + 2.0f * t2 + 0.5f * t, 0.5f * t3 - 0.5f * t2};
}

}  // namespace

Image read_image(const std::filesystem::path& file) {
  if (const std::string why = why_unreadable(file); !why.empty())
    throw std::runtime_error(file.string() + ": " + why);
  int width = 0, height = 0, channels = 0;
  stbi_uc* data = stbi_load(file.c_str(), &width, &height, &channels, 4);
  if (!data)
    throw std::runtime_error(file.string() +
                             ": is no image that can be read; save it as PNG or JPEG");
  Image out;
  out.name = file.stem().string();
  out.width = static_cast<std::uint32_t>(width);
  out.height = static_cast<std::uint32_t>(height);
  out.rgba.assign(data, data + std::size_t{out.width} * out.height * 4);
  stbi_image_free(data);
  for (std::size_t i = 3; i < out.rgba.size(); i += 4) out.has_alpha |= out.rgba[i] != 255;
  return out;
}

void write_png(const Image& image, const std::filesystem::path& file) {
  const int w = static_cast<int>(image.width), h = static_cast<int>(image.height);
  std::string bytes;
  const auto add = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                          static_cast<std::size_t>(size));
  };
  if (!stbi_write_png_to_func(add, &bytes, w, h, 4, image.rgba.data(), 4 * w))
    throw std::runtime_error(file.string() + ": no memory for the picture; make it smaller");
  write_file(file, bytes);
}

float srgb_to_linear(float c) {
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

float linear_to_srgb(float c) {
  return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
}

LinearImage to_linear(const Image& image) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < 256; ++i) table[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
  LinearImage out(image.width, image.height, Vec4{0});
  for (std::size_t i = 0; i < out.texel.size(); ++i) {
    const std::uint8_t* p = image.rgba.data() + 4 * i;
    out.texel[i] = {table[p[0]], table[p[1]], table[p[2]], static_cast<float>(p[3]) / 255.0f};
  }
  return out;
}

Image to_srgb(const LinearImage& image, std::string name) {
  Image out;
  out.name = std::move(name);
  out.width = image.width;
  out.height = image.height;
  out.rgba.resize(image.texel.size() * 4);
  const auto byte = [](float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
  };
  for (std::size_t i = 0; i < image.texel.size(); ++i) {
    for (int k = 0; k < 3; ++k)
      out.rgba[4 * i + static_cast<std::size_t>(k)] = byte(linear_to_srgb(image.texel[i][k]));
    out.rgba[4 * i + 3] = byte(image.texel[i][3]);
    out.has_alpha |= out.rgba[4 * i + 3] != 255;
  }
  return out;
}

Vec4 sample_bilinear(const LinearImage& image, Vec2 uv) {
  const float x = uv.x * static_cast<float>(image.width) - 0.5f;
  const float y = uv.y * static_cast<float>(image.height) - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const Vec4 top = glm::mix(fetch(image, x0, y0), fetch(image, x0 + 1, y0), fx);
  const Vec4 bottom = glm::mix(fetch(image, x0, y0 + 1), fetch(image, x0 + 1, y0 + 1), fx);
  return glm::mix(top, bottom, fy);
}

Vec4 sample_bicubic(const LinearImage& image, Vec2 uv) {
  const float x = uv.x * static_cast<float>(image.width) - 0.5f;
  const float y = uv.y * static_cast<float>(image.height) - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const auto wx = catmull_rom(x - static_cast<float>(x0));
  const auto wy = catmull_rom(y - static_cast<float>(y0));
  Vec4 sum{0};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      sum += wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] *
             fetch(image, x0 - 1 + i, y0 - 1 + j);
  return glm::max(sum, Vec4{0});
}

LinearImage resize(const LinearImage& image, std::uint32_t width, std::uint32_t height) {
  LinearImage out(width, height, Vec4{0});
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::uint32_t y0 = y * image.height / height;
    const std::uint32_t y1 = std::max(y0 + 1, (y + 1) * image.height / height);
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t x0 = x * image.width / width;
      const std::uint32_t x1 = std::max(x0 + 1, (x + 1) * image.width / width);
      Vec4 weighted{0}, plain{0};
      for (std::uint32_t v = y0; v < y1; ++v)
        for (std::uint32_t u = x0; u < x1; ++u) {
          const Vec4 t = image.at(u, v);
          weighted += Vec4{t.x * t.w, t.y * t.w, t.z * t.w, t.w};
          plain += t;
        }
      const float count = static_cast<float>((y1 - y0) * (x1 - x0));
      const Vec4 color = weighted.w > 0 ? weighted / weighted.w : plain / count;
      out.at(x, y) = {color.x, color.y, color.z, weighted.w / count};
    }
  }
  return out;
}

void set_contrast(LinearImage& image, float contrast) {
  const auto grey = [](const Vec4& t) { return 0.2126f * t.x + 0.7152f * t.y + 0.0722f * t.z; };
  float sum = 0.0f, weight = 1e-6f;
  for (const Vec4& t : image.texel) sum += t.w * grey(t), weight += t.w;
  const float mean = std::max(sum / weight, 1e-4f);
  for (Vec4& t : image.texel) {
    const float gain = std::pow(std::max(grey(t), 1e-4f) / mean, contrast - 1.0f);
    t = Vec4{gain * Vec3{t}, t.w};
  }
}

void bleed_alpha(LinearImage& image, float below) {
  // Push-pull: averages of opaque texels on ever coarser grids fill the holes of the finer ones.
  std::vector<LinearImage> levels{image};
  for (Vec4& t : levels[0].texel) t = {t.x * t.w, t.y * t.w, t.z * t.w, t.w};
  while (levels.back().width > 1 && levels.back().height > 1) {
    const LinearImage& fine = levels.back();
    LinearImage coarse(fine.width / 2, fine.height / 2, Vec4{0});
    for (std::uint32_t y = 0; y < coarse.height; ++y)
      for (std::uint32_t x = 0; x < coarse.width; ++x)
        coarse.at(x, y) = 0.25f * (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) +
                                   fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1));
    levels.push_back(std::move(coarse));
  }
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      Vec4& t = image.at(x, y);
      for (std::size_t level = 0; level < levels.size() && t.w < below; ++level) {
        const LinearImage& grid = levels[level];
        const Vec4 mean =
            grid.at(std::min(x >> level, grid.width - 1), std::min(y >> level, grid.height - 1));
        if (mean.w < 0.5f * below) continue;
        t = {mean.x / mean.w, mean.y / mean.w, mean.z / mean.w, t.w};
        break;
      }
    }
}

}  // namespace caryatid::bake
