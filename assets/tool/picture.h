#pragma once
// RGB pictures for the tool's sheets: captions, grids, PNG.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace caryatid::tool {

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // First row on top.

  Picture() = default;
  Picture(std::uint32_t w, std::uint32_t h, std::uint8_t grey = 32)
      : width(w), height(h), rgb(std::size_t{3} * w * h, grey) {}
};

// Writes PNG, or JPEG where the name ends in .jpg; throws std::runtime_error when the file can't be
// written.
void write_png(const Picture& picture, const std::string& path);

// Half the size, each pixel the mean of four (in linear light, so that edges keep their weight).
Picture halved(const Picture& picture);

// Copies `from` into `to` with its top left corner at (x, y); what lies outside is cut.
void paste(const Picture& from, std::uint32_t x, std::uint32_t y, Picture* to);

struct Box {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};
// Fills the box with one grey; what lies outside is cut.
void fill_box(const Box& box, std::uint8_t grey, Picture* to);

// UTF-8 text in DejaVu Sans (Debian's fonts-dejavu-core), white, baseline at y. Throws when there
// is no font.
void draw_text(std::string_view text, int x, int y, float pixel_height, Picture* to);

// How many pixels draw_text() advances for it.
float text_width(std::string_view text, float pixel_height);

// Pictures of one size in rows of `columns`, each with its caption beneath (none when empty).
Picture grid(const std::vector<Picture>& cells, const std::vector<std::string>& captions,
             std::uint32_t columns);

}  // namespace caryatid::tool
