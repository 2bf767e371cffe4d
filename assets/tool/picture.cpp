#include "assets/tool/picture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "assets/bake/files/files.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#include <stb_image_write.h>
#include <stb_truetype.h>
#pragma GCC diagnostic pop

namespace caryatid::tool {
namespace {

constexpr const char* kFontFile = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

struct Font {
  std::vector<unsigned char> bytes;
  stbtt_fontinfo info{};

  Font() {
    std::ifstream file(kFontFile, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
    if (bytes.empty() || stbtt_InitFont(&info, bytes.data(), 0) == 0)
      throw std::runtime_error(std::string(kFontFile) + ": no font; install fonts-dejavu-core");
  }
};

const Font& the_font() {
  static const Font font;
  return font;
}

// Takes one character off the front of valid UTF-8.
int next_code_point(std::string_view* io_text) {
  const auto byte = [io_text](std::size_t i) {
    return i < io_text->size() ? static_cast<unsigned char>((*io_text)[i]) : 0;
  };
  const int lead = byte(0);
  const std::size_t bytes = lead < 0xC0 ? 1 : (lead < 0xE0 ? 2 : (lead < 0xF0 ? 3 : 4));
  int code = bytes == 1 ? lead : lead & (0x7F >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) code = code << 6 | (byte(i) & 0x3F);
  io_text->remove_prefix(std::min(bytes, io_text->size()));
  return code;
}

double to_linear(std::uint8_t v) { return std::pow(v / 255.0, 2.2); }

}  // namespace

void write_png(const Picture& picture, const std::string& path) {
  const auto w = static_cast<int>(picture.width), h = static_cast<int>(picture.height);
  std::string bytes;
  const auto add = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                          static_cast<std::size_t>(size));
  };
  const bool made =
      path.ends_with(".jpg")
          ? stbi_write_jpg_to_func(add, &bytes, w, h, 3, picture.rgb.data(), 88) != 0
          : stbi_write_png_to_func(add, &bytes, w, h, 3, picture.rgb.data(), 3 * w) != 0;
  if (!made) throw std::runtime_error(path + ": no memory for the picture; make it smaller");
  bake::write_file(path, bytes);
}

Picture halved(const Picture& p) {
  Picture out(p.width / 2, p.height / 2);
  static const std::vector<double> linear = [] {
    std::vector<double> t(256);
    for (int i = 0; i < 256; ++i)
      t[static_cast<std::size_t>(i)] = to_linear(static_cast<std::uint8_t>(i));
    return t;
  }();
  for (std::size_t y = 0; y < out.height; ++y)
    for (std::size_t x = 0; x < out.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = (2 * y * p.width + 2 * x) * 3 + c, row = std::size_t{3} * p.width;
        const double sum = linear[p.rgb[at]] + linear[p.rgb[at + 3]] + linear[p.rgb[at + row]] +
                           linear[p.rgb[at + row + 3]];
        out.rgb[(y * out.width + x) * 3 + c] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::pow(sum / 4.0, 1.0 / 2.2)));
      }
  return out;
}

void paste(const Picture& from, std::uint32_t x, std::uint32_t y, Picture* to) {
  if (x >= to->width) return;
  const std::size_t w = std::min(from.width, to->width - x);
  for (std::uint32_t row = 0; row < from.height && y + row < to->height; ++row)
    std::copy_n(&from.rgb[std::size_t{3} * row * from.width], 3 * w,
                &to->rgb[(std::size_t{y + row} * to->width + x) * 3]);
}

void fill_box(const Box& box, std::uint8_t grey, Picture* to) {
  if (box.x >= to->width) return;
  const std::size_t w = std::min(box.width, to->width - box.x);
  for (std::uint32_t y = box.y; y < box.y + box.height && y < to->height; ++y)
    std::fill_n(&to->rgb[(std::size_t{y} * to->width + box.x) * 3], 3 * w, grey);
}

void draw_text(std::string_view text, int x, int y, float pixel_height, Picture* to) {
  const Font& font = the_font();
  const float scale = stbtt_ScaleForPixelHeight(&font.info, pixel_height);
  auto pen = static_cast<float>(x);
  while (!text.empty()) {
    const int c = next_code_point(&text);
    int w = 0, h = 0, dx = 0, dy = 0, advance = 0, bearing = 0;
    unsigned char* glyph = stbtt_GetCodepointBitmap(&font.info, 0, scale, c, &w, &h, &dx, &dy);
    for (int gy = 0; gy < h; ++gy)
      for (int gx = 0; gx < w; ++gx) {
        const int px = static_cast<int>(pen) + dx + gx, py = y + dy + gy;
        if (px < 0 || py < 0 || px >= static_cast<int>(to->width) ||
            py >= static_cast<int>(to->height))
          continue;
        const int cover = glyph[gy * w + gx];
        for (std::size_t k = 0; k < 3; ++k) {
          auto& v =
              to->rgb[(static_cast<std::size_t>(py) * to->width + static_cast<std::size_t>(px)) *
                          3 +
                      k];
          v = static_cast<std::uint8_t>(v + (255 - v) * cover / 255);
        }
      }
    stbtt_FreeBitmap(glyph, nullptr);
    stbtt_GetCodepointHMetrics(&font.info, c, &advance, &bearing);
    pen += scale * static_cast<float>(advance);
  }
}

float text_width(std::string_view text, float pixel_height) {
  const Font& font = the_font();
  const float scale = stbtt_ScaleForPixelHeight(&font.info, pixel_height);
  int sum = 0;
  while (!text.empty()) {
    int advance = 0, bearing = 0;
    stbtt_GetCodepointHMetrics(&font.info, next_code_point(&text), &advance, &bearing);
    sum += advance;
  }
  return scale * static_cast<float>(sum);
}

Picture grid(const std::vector<Picture>& cells, const std::vector<std::string>& captions,
             std::uint32_t columns) {
  constexpr std::uint32_t kGap = 6, kCaption = 26;
  constexpr float kLetters = 18.0f;
  if (cells.empty()) return {};
  const bool captioned = !captions.empty();
  const std::uint32_t cell_h = cells[0].height + (captioned ? kCaption : 0) + kGap;
  const std::uint32_t cell_w = cells[0].width + kGap;
  const auto rows = static_cast<std::uint32_t>((cells.size() + columns - 1) / columns);
  Picture out(columns * cell_w + kGap, rows * cell_h + kGap);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t x = kGap + i % columns * cell_w, y = kGap + i / columns * cell_h;
    paste(cells[i], x, y, &out);
    if (!captioned || i >= captions.size()) continue;
    // Long captions shrink to the width of their picture.
    const float room = static_cast<float>(cells[i].width) - 4.0f;
    const float letters = kLetters * std::min(1.0f, room / text_width(captions[i], kLetters));
    draw_text(captions[i], static_cast<int>(x) + 4, static_cast<int>(y + cells[i].height) + 19,
              letters, &out);
  }
  return out;
}

}  // namespace caryatid::tool
