#pragma once
// What .fap and .bap text files share: a header line, then for each frame a line of 0/1 flags and a
// line of numbers. Written by hand and by a dozen tools, so the reader goes by what it counts, not
// by what a version number promises.
//
//   [# comment lines]
//   VERSION NAME FPS FRAMES          NAME may hold blanks; FRAMES is a promise, not checked
//   MASK LINE                        68 flags (.fap), 186 or 296 (.bap); one more from Greta's
//   tools FRAME_INDEX VALUE...             one value per flag that is 1, in order of number
//
// Accepted beside that: CRLF, blanks at line ends, comments anywhere, lines that are wrapped, no
// newline at the end, frame indices from any start, fewer or more frames than promised, decimals.
// Memory: fixed, the bytes are borrowed. Cost: O(bytes). Nothing here asserts on data.
#include <array>
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/status.h"

namespace caryatid::stream {

// Detail of a Status from the text readers and writers. describe() has the words.
enum class TextFault : std::uint16_t {
  none,
  end_of_text,       // not_ready: every frame has been read.
  need_more,         // not_ready: the text goes on, refill() first.
  header_short,      // corrupt_data, as all that follow.
  header_rate,       // Frames per second are not a number in (0, 1000].
  header_frames,     // The count of frames is not a whole number.
  mask_flag,         // A flag that is neither 0 nor 1.
  mask_columns,      // Flags do not add up to a known number at the end of a line.
  not_a_number,      // Or one beyond +-1e9.
  value_count,       // The line holds fewer or more values than the flags ask for.
  cut_off,           // The text ends within a frame.
  viseme_field,      // FAP 1: viseme 0..14, blend 0..63, def 0/1.
  expression_field,  // FAP 2: expression 0..6, intensity 0..63, flags 0/1.
  out_of_room,       // out_of_capacity: the writer's span is too short.
};

// One line: what is wrong, and what to do about it. Static storage.
const char* describe(TextFault fault);
inline const char* describe_text_fault(Status status) {
  return describe(static_cast<TextFault>(status.detail));
}

struct TextHeader {
  FixedString<15> version;  // "2.1", "3.2", ...; says nothing reliable.
  FixedString<95> name;
  float frames_per_second = 25.0f;
  std::uint32_t frame_count = 0;  // As promised; count the frames yourself.
};

inline constexpr std::size_t kMaxTextColumns = 297;
// FAPs 1 and 2 stand for 4 and 6 numbers.
inline constexpr std::size_t kMaxTextValues = kMaxTextColumns + 3 + 5;

struct TextFrame {
  std::int32_t index = 0;  // As the file says: may start anywhere and jump.
  std::size_t columns = 0;
  BitSet<kMaxTextColumns + 1> mask;  // By number, from 1.
  std::size_t value_count = 0;
  std::array<float, kMaxTextValues> values{};
};

// The layout that tells .fap from .bap.
struct TextLayout {
  std::array<std::uint16_t, 4> columns;  // Numbers of flags that are known; unused entries 0.
  bool expands_fields;                   // Parameters 1 and 2 stand for 4 and 6 numbers.
};

// Reads frames from borrowed text that may arrive in pieces. Use it through FapTextReader and
// BapTextReader (fap_text.h, bap_text.h).
class TextFrameReader {
 public:
  // complete: no text follows `text`.
  TextFrameReader(const TextLayout& layout, std::span<const char> text, bool complete)
      : layout_(layout), text_(text), complete_(complete) {}

  // Goes on with `text`, which starts at the first byte that was not consumed() yet.
  void refill(std::span<const char> text, bool complete);
  // Bytes of the present text that are no longer needed.
  std::size_t consumed_bytes() const { return committed_; }

  // The header, once; next() reads it by itself. Repeated calls return the same.
  Status read_header();
  const TextHeader& header() const { return header_; }
  // The next frame. A fault stays: further calls return it again. On any error *out is unspecified.
  Status next(TextFrame* out);
  // Line (from 1) of the last fault, or of the last frame's values.
  std::uint32_t line() const { return report_line_; }

 private:
  struct Token {
    const char* begin = nullptr;
    std::size_t size = 0;
  };
  bool next_token(Token* out);
  bool line_ends();
  bool is_known(std::size_t columns) const;
  bool out_of_text() const { return position_ == text_.size() && !complete_; }
  Status parse_header();
  Status parse_mask(TextFrame* out);
  Status parse_values(TextFrame* out);
  Status fail(TextFault fault);
  Status end_inside(TextFault fault_if_complete);

  TextLayout layout_;
  std::span<const char> text_;
  bool complete_;
  std::size_t position_ = 0;
  std::size_t committed_ = 0;
  std::uint32_t line_ = 1;
  std::uint32_t committed_line_ = 1;
  std::uint32_t report_line_ = 1;
  bool has_header_ = false;
  Status fault_{};
  TextHeader header_;
};

// A decimal number: [+-]digits[.digits][(e|E)[+-]digits]. False for anything else and beyond +-1e9.
bool parse_number(std::span<const char> token, float* out);

// Appends text to a borrowed buffer; once something does not fit, ok() stays false.
class TextSink {
 public:
  explicit TextSink(std::span<char> out) : out_(out) {}
  void put(char c);
  void put(std::span<const char> text);
  // Whole number nearest to the value, halves away from zero.
  void put_number(float value);
  void put_integer(std::int64_t value);
  bool ok() const { return ok_; }
  std::size_t size() const { return size_; }

 private:
  std::span<char> out_;
  std::size_t size_ = 0;
  bool ok_ = true;
};

// VERSION NAME FPS FRAMES and a newline: the bytes written, or out_of_capacity.
Result<std::size_t> write_text_header(const TextHeader& header, std::span<char> out);

}  // namespace caryatid::stream
