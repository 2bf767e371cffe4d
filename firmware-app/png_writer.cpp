#include "firmware-app/png_writer.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace {

// The encoder's memory: a stack inside the writer's scratch block, reset for each picture. The last
// block can grow in place, which is all that the encoder asks of realloc in its inner loop.
struct Scratch {
  std::byte* begin = nullptr;
  std::size_t size = 0, used = 0, last = 0;

  void* take(std::size_t bytes) {
    bytes = (bytes + 15u) & ~std::size_t{15};
    if (bytes > size - used) return nullptr;
    last = used;
    used += bytes;
    return begin + last;
  }
  void* grow(void* block, std::size_t old_bytes, std::size_t bytes) {
    bytes = (bytes + 15u) & ~std::size_t{15};
    if (block != nullptr && block == begin + last && bytes <= size - last) {
      used = last + bytes;
      return block;
    }
    void* moved = take(bytes);
    if (moved != nullptr && block != nullptr) std::memcpy(moved, block, std::min(old_bytes, bytes));
    return moved;
  }
};
Scratch g_scratch;

}  // namespace

#define STBIW_MALLOC(size) g_scratch.take(size)
#define STBIW_REALLOC(block, size) g_scratch.grow(block, size, size)
#define STBIW_REALLOC_SIZED(block, old_size, size) g_scratch.grow(block, old_size, size)
#define STBIW_FREE(block) ((void)(block))
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace caryatid::app {
namespace {

constexpr std::uint32_t kSheetColumns = 6, kSheetPictures = 36, kSheetCell = 320;

// 3x5 digits and a point, one row of bits each, for the time on the sheet.
constexpr std::uint8_t kDigits[11][5] = {{7, 5, 5, 5, 7}, {2, 6, 2, 2, 7}, {7, 1, 7, 4, 7},
                                         {7, 1, 7, 1, 7}, {5, 5, 7, 1, 1}, {7, 4, 7, 1, 7},
                                         {7, 4, 7, 5, 7}, {7, 1, 1, 1, 1}, {7, 5, 7, 5, 7},
                                         {7, 5, 7, 1, 7}, {0, 0, 0, 0, 2}};

}  // namespace

void PngWriter::start(std::uint32_t width, std::uint32_t height) {
  // Filtered lines, the zlib stream in the worst case, its growth by doubling, the hash table.
  scratch_bytes_ = std::size_t{width} * height * 3 * 7 + (std::size_t{4} << 20);
  scratch_ = std::make_unique<std::byte[]>(scratch_bytes_);
}

bool PngWriter::write(const char* path, std::span<const std::uint8_t> rgb, std::uint32_t width,
                      std::uint32_t height) {
  g_scratch = {scratch_.get(), scratch_bytes_, 0, 0};
  stbi_write_png_compression_level = 5;
  const auto w = static_cast<int>(width), h = static_cast<int>(height);
  return stbi_write_png(path, w, h, 3, rgb.data(), 3 * w) != 0;
}

bool FramesOut::start(const std::string& directory, std::uint32_t every, std::uint32_t width,
                      std::uint32_t height, std::uint32_t picture_count) {
  if (mkdir(directory.c_str(), 0755) != 0 && errno != EEXIST) return false;
  directory_ = directory;
  every_ = every;
  width_ = width;
  height_ = height;
  picture_count_ = std::max(picture_count, 1u);
  sheet_stride_ = (picture_count_ + kSheetPictures - 1) / kSheetPictures;
  const std::uint32_t cells = (picture_count_ + sheet_stride_ - 1) / sheet_stride_;
  columns_ = std::min(cells, kSheetColumns);
  rows_ = (cells + columns_ - 1) / columns_;
  cell_width_ = std::min(kSheetCell, width);
  cell_height_ = std::max(cell_width_ * height / width, 1u);
  rgb_ = std::make_unique<std::uint8_t[]>(std::size_t{3} * width * height);
  const std::size_t sheet_bytes = std::size_t{3} * columns_ * cell_width_ * rows_ * cell_height_;
  sheet_ = std::make_unique<std::uint8_t[]>(sheet_bytes);
  png_.start(std::max(width, columns_ * cell_width_), std::max(height, rows_ * cell_height_));
  return true;
}

bool FramesOut::add(std::uint64_t frame, double time_s) {
  char path[512];
  const int n = std::snprintf(path, sizeof path, "%s/frame_%05llu.png", directory_.c_str(),
                              static_cast<unsigned long long>(frame));
  if (n < 0 || n >= static_cast<int>(sizeof path)) return false;
  if (pictures_++ % sheet_stride_ == 0) place_on_sheet(time_s);
  return png_.write(path, {rgb_.get(), std::size_t{3} * width_ * height_}, width_, height_);
}

void FramesOut::place_on_sheet(double time_s) {
  if (placed_ >= columns_ * rows_) return;
  const std::uint32_t x0 = placed_ % columns_ * cell_width_, y0 = placed_ / columns_ * cell_height_;
  const std::size_t stride = std::size_t{3} * columns_ * cell_width_;
  ++placed_;
  for (std::uint32_t y = 0; y < cell_height_; ++y)
    for (std::uint32_t x = 0; x < cell_width_; ++x) {
      // Box filter over the source pixels of this cell pixel.
      const std::uint32_t sx0 = x * width_ / cell_width_, sy0 = y * height_ / cell_height_;
      const std::uint32_t sx1 = std::max((x + 1) * width_ / cell_width_, sx0 + 1);
      const std::uint32_t sy1 = std::max((y + 1) * height_ / cell_height_, sy0 + 1);
      std::uint32_t sum[3] = {}, count = 0;
      for (std::uint32_t sy = sy0; sy < sy1; ++sy)
        for (std::uint32_t sx = sx0; sx < sx1; ++sx, ++count)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += rgb_[(std::size_t{sy} * width_ + sx) * 3 + c];
      for (std::size_t c = 0; c < 3; ++c)
        sheet_[(y0 + y) * stride + std::size_t{3} * (x0 + x) + c] =
            static_cast<std::uint8_t>(sum[c] / count);
    }
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", time_s);
  constexpr std::uint32_t kScale = 2;
  for (std::uint32_t i = 0; text[i] != '\0'; ++i)
    for (std::uint32_t py = 0; py < 5 * kScale; ++py)
      for (std::uint32_t px = 0; px < 3 * kScale; ++px) {
        const std::size_t glyph = text[i] == '.' ? 10 : static_cast<std::size_t>(text[i] - '0');
        const std::uint32_t x = 4 + i * 4 * kScale + px, y = 4 + py;
        if (glyph > 10 || x >= cell_width_ || y >= cell_height_) continue;
        if ((kDigits[glyph][py / kScale] >> (2 - px / kScale) & 1) == 0) continue;
        std::memset(&sheet_[(y0 + y) * stride + std::size_t{3} * (x0 + x)], 255, 3);
      }
}

bool FramesOut::finish() {
  if (placed_ == 0) return true;
  const std::string path = directory_ + "/sheet.png";
  const std::uint32_t w = columns_ * cell_width_,
                      h = (placed_ + columns_ - 1) / columns_ * cell_height_;
  return png_.write(path.c_str(), {sheet_.get(), std::size_t{3} * w * h}, w, h);
}

}  // namespace caryatid::app
