#include "firmware-app/pictures.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace caryatid::app {
namespace {

// What a file's packed data may unfold to: the largest picture twice, which is what decoding takes.
constexpr std::size_t kMostDecodeBytes = 8 * static_cast<std::size_t>(kMostPicturePixels);

void* bounded_malloc(std::size_t bytes) {
  return bytes > kMostDecodeBytes ? nullptr : std::malloc(bytes);
}
void* bounded_realloc(void* old, std::size_t bytes) {
  return bytes > kMostDecodeBytes ? nullptr : std::realloc(old, bytes);
}

}  // namespace
}  // namespace caryatid::app

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MALLOC(bytes) caryatid::app::bounded_malloc(bytes)
#define STBI_REALLOC(old, bytes) caryatid::app::bounded_realloc(old, bytes)
#define STBI_FREE(old) std::free(old)
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#define STB_IMAGE_RESIZE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wundef"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb_image.h>
#include <stb_image_resize.h>
#pragma GCC diagnostic pop

namespace caryatid::app {
namespace {

struct Free {
  void operator()(unsigned char* p) const { std::free(p); }
};

// What a PNG says of its size, which stb refuses without a number when it is far too large.
bool png_size(std::string_view bytes, std::uint32_t* out_width, std::uint32_t* out_height) {
  if (bytes.size() < 24 || bytes.substr(0, 4) != "\x89PNG") return false;
  std::uint32_t* const sides[] = {out_width, out_height};
  for (std::size_t side = 0; side < 2; ++side) {
    *sides[side] = 0;
    for (std::size_t i = 0; i < 4; ++i)
      *sides[side] = *sides[side] << 8 | static_cast<unsigned char>(bytes[16 + 4 * side + i]);
  }
  return true;
}

bool too_large(std::uint32_t width, std::uint32_t height, std::string* out_error) {
  if (width <= kMostPictureSide && height <= kMostPictureSide &&
      std::int64_t{width} * height <= kMostPicturePixels)
    return false;
  *out_error = "is " + std::to_string(width) + "x" + std::to_string(height) + " pixels; at most " +
               std::to_string(kMostPicturePixels >> 20) + " million: make it smaller";
  return true;
}

std::uint32_t power_of_two_from(std::uint32_t n, std::uint32_t most) {
  std::uint32_t p = 4;
  while (p < n && p < most) p *= 2;
  return p;
}

// Transparent parts show the card beneath, whose colour is fixed.
void lay_on_card(unsigned char* rgba, std::size_t pixels) {
  constexpr unsigned kCard[3] = {17, 22, 30};
  for (std::size_t p = 0; p < pixels; ++p) {
    unsigned char* at = rgba + 4 * p;
    for (std::size_t c = 0; c < 3; ++c)
      at[c] = static_cast<unsigned char>((at[c] * at[3] + kCard[c] * (255u - at[3]) + 127u) / 255u);
  }
}

}  // namespace

bool decode_picture(std::string_view bytes, std::uint32_t most_side, Picture* out,
                    std::string* out_error) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const int size = static_cast<int>(std::min(bytes.size(), kMostPictureBytes));
  int w = 0, h = 0, channels = 0;
  std::uint32_t says_width = 0, says_height = 0;
  if (png_size(bytes, &says_width, &says_height) && too_large(says_width, says_height, out_error))
    return false;
  if (!stbi_info_from_memory(data, size, &w, &h, &channels)) {
    *out_error = "is no PNG or JPEG; save it as one";
    return false;
  }
  if (too_large(static_cast<std::uint32_t>(w), static_cast<std::uint32_t>(h), out_error))
    return false;
  const std::unique_ptr<unsigned char, Free> rgba(
      stbi_load_from_memory(data, size, &w, &h, &channels, 4));
  if (!rgba) {
    *out_error = "is a damaged picture; save it again";
    return false;
  }
  lay_on_card(rgba.get(), static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  out->width = static_cast<std::uint16_t>(w);
  out->height = static_cast<std::uint16_t>(h);
  const std::uint32_t tw = power_of_two_from(static_cast<std::uint32_t>(w), most_side);
  const std::uint32_t th = power_of_two_from(static_cast<std::uint32_t>(h), most_side);
  out->texture_width = static_cast<std::uint16_t>(tw);
  out->texture_height = static_cast<std::uint16_t>(th);
  std::vector<unsigned char> fitted;
  const unsigned char* pixels = rgba.get();
  if (tw != out->width || th != out->height) {
    fitted.resize(std::size_t{4} * tw * th);
    stbir_resize_uint8_srgb(rgba.get(), w, h, 0, fitted.data(), static_cast<int>(tw),
                            static_cast<int>(th), 0, 4, STBIR_ALPHA_CHANNEL_NONE, 0);
    pixels = fitted.data();
  }
  out->texels.resize(std::size_t{tw} * th);
  for (std::size_t p = 0; p < out->texels.size(); ++p) {
    const unsigned char* at = &pixels[4 * p];
    const auto step = [](unsigned value, unsigned most) { return (value * most + 127u) / 255u; };
    out->texels[p] =
        static_cast<std::uint16_t>(step(at[0], 31) << 11 | step(at[1], 63) << 5 | step(at[2], 31));
  }
  return true;
}

}  // namespace caryatid::app
