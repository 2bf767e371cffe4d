#pragma once
// Reads and writes .fap text, the form in which face animation is exchanged between tools: 68 flags
// and the values of the flagged FAPs, frame by frame (text_frame.h describes the grammar and what
// is tolerated). Values are in the FAP's own unit, as in FapFrame; nothing is scaled or clamped.
#include <cstddef>
#include <span>

#include "core/face/fap.h"
#include "core/stream/text_frame.h"

namespace caryatid::stream {

// Frames of a .fap text that is borrowed, whole or piece by piece.
//
//   FapTextReader reader(text);
//   face::FapFrame frame;
//   while (reader.next(&frame).ok()) play(frame);
//   // the last status tells end_of_text from a fault; reader.line() names the line
//
// FAPs 1 and 2 come as 4 and 6 numbers; a line with a single number for them (Greta's tools) means
// that viseme alone, or that expression at full intensity.
class FapTextReader {
 public:
  // complete: no text follows; false for a pipe, then see refill().
  explicit FapTextReader(std::span<const char> text, bool complete = true);

  // Continues with text that starts at the first byte not yet consumed_bytes().
  void refill(std::span<const char> text, bool complete) { reader_.refill(text, complete); }
  std::size_t consumed_bytes() const { return reader_.consumed_bytes(); }

  // Reads the header if that has not happened. Errors: as next().
  Status read_header() { return reader_.read_header(); }
  const TextHeader& header() const { return reader_.header(); }

  // Sets the mask and the flagged values of *io_frame; other values keep what they held. On error
  // *io_frame is unchanged. not_ready: end_of_text or need_more. corrupt_data: any other TextFault,
  // which then stays.
  Status next(face::FapFrame* io_frame);
  // The file's own number of the last frame.
  std::int32_t frame_index() const { return frame_.index; }
  // Line (from 1) of the last fault or frame.
  std::uint32_t line() const { return reader_.line(); }

 private:
  Status read_fields(face::FapFrame* out, std::size_t* out_used) const;

  TextFrameReader reader_;
  TextFrame frame_;
};

// No frame is longer: 68 flags and 76 numbers of at most 11 characters, each with its blank.
inline constexpr std::size_t kMaxFapTextFrameBytes = 68 * 2 + 12 + 76 * 12 + 2;

// Two lines for one frame; values are rounded to whole units. Returns the bytes written;
// out_of_capacity when `out` is too short, `out` is then unspecified.
Result<std::size_t> write_fap_text(std::int32_t index, const face::FapFrame& frame,
                                   std::span<char> out);

}  // namespace caryatid::stream
