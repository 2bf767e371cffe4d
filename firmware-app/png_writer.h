#pragma once
// Pictures of the run: PNG frames and one contact sheet. All memory is taken in start(); writing a
// frame allocates nothing.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace caryatid::app {

// Writes `rgb` (3 * width * height bytes, first row on top) as PNG. False when the file can't be
// written or the scratch memory does not do.
class PngWriter {
 public:
  void start(std::uint32_t width, std::uint32_t height);
  bool write(const char* path, std::span<const std::uint8_t> rgb, std::uint32_t width,
             std::uint32_t height);

 private:
  std::unique_ptr<std::byte[]> scratch_;
  std::size_t scratch_bytes_ = 0;
};

// --frames-out: every N-th frame as DIR/frame_00000.png, and DIR/sheet.png at the end, on which
// each picture carries its time in seconds.
class FramesOut {
 public:
  // frame_count: how many pictures are expected at most; the sheet spreads over the whole run.
  // False: the directory can't be made.
  bool start(const std::string& directory, std::uint32_t every, std::uint32_t width,
             std::uint32_t height, std::uint32_t picture_count);
  bool wants(std::uint64_t frame) const { return every_ > 0 && frame % every_ == 0; }
  std::span<std::uint8_t> buffer() { return {rgb_.get(), std::size_t{3} * width_ * height_}; }
  bool add(std::uint64_t frame, double time_s);  // The picture is in buffer().
  bool finish();

 private:
  void place_on_sheet(double time_s);

  std::string directory_;
  std::uint32_t every_ = 0, width_ = 0, height_ = 0;
  std::uint32_t picture_count_ = 0, pictures_ = 0, sheet_stride_ = 1, placed_ = 0;
  std::uint32_t cell_width_ = 0, cell_height_ = 0, columns_ = 0, rows_ = 0;
  std::unique_ptr<std::uint8_t[]> rgb_, sheet_;
  PngWriter png_;
};

}  // namespace caryatid::app
