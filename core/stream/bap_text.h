#pragma once
// Reads and writes .bap text, the body's sibling of .fap (fap_text.h): 186 flags, or 296 with the
// extension parameters, then the values of the flagged BAPs. Which of the two a file has is seen
// from its lines; version numbers do not tell. Units as in BapFrame: 1e-5 rad, and mm for 181..183.
#include <cstddef>
#include <span>

#include "core/body/bap.h"
#include "core/stream/text_frame.h"

namespace caryatid::stream {

// Frames of a .bap text that is borrowed, whole or piece by piece. Use as FapTextReader.
class BapTextReader {
 public:
  explicit BapTextReader(std::span<const char> text, bool complete = true);

  void refill(std::span<const char> text, bool complete) { reader_.refill(text, complete); }
  std::size_t consumed_bytes() const { return reader_.consumed_bytes(); }
  Status read_header() { return reader_.read_header(); }
  const TextHeader& header() const { return reader_.header(); }

  // Sets the mask and the flagged values of *io_frame; other values keep what they held. On error
  // *io_frame is unchanged. not_ready: end_of_text or need_more. corrupt_data: any other TextFault,
  // which then stays.
  Status next(body::BapFrame* io_frame);
  std::int32_t frame_index() const { return frame_.index; }
  std::uint32_t line() const { return reader_.line(); }

 private:
  TextFrameReader reader_;
  TextFrame frame_;
};

// No frame is longer: 296 flags and 297 numbers of at most 11 characters, each with its blank.
inline constexpr std::size_t kMaxBapTextFrameBytes = 296 * 2 + 297 * 12 + 2;

// Two lines for one frame, with 186 flags unless an extension BAP is present; values are rounded to
// whole units. Returns the bytes written; out_of_capacity when `out` is too short.
Result<std::size_t> write_bap_text(std::int32_t index, const body::BapFrame& frame,
                                   std::span<char> out);

}  // namespace caryatid::stream
