#include "core/stream/text_frame.h"

#include <algorithm>

namespace caryatid::stream {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr float kLargestNumber = 1e9f;
constexpr float kLargestRate = 1000.0f;

constexpr Status status_of(Code code, TextFault fault) {
  return {code, static_cast<std::uint16_t>(fault)};
}

// Digits from `at` on, with a sign before them if any; false when there is none.
bool parse_exponent(std::span<const char> token, std::size_t at, int* out) {
  bool negative = false;
  if (at < token.size() && (token[at] == '+' || token[at] == '-')) negative = token[at++] == '-';
  if (at == token.size()) return false;
  int exponent = 0;
  for (; at < token.size(); ++at) {
    if (!is_digit(token[at])) return false;
    exponent = std::min(exponent * 10 + (token[at] - '0'), 1000);
  }
  *out = negative ? -exponent : exponent;
  return true;
}

}  // namespace

const char* describe(TextFault fault) {
  switch (fault) {
    case TextFault::none:
      return "nothing is wrong";
    case TextFault::end_of_text:
      return "every frame has been read";
    case TextFault::need_more:
      return "the text goes on; read more of it first";
    case TextFault::header_short:
      return "no header; write 'VERSION NAME FPS FRAMES' before the first frame";
    case TextFault::header_rate:
      return "frames per second are not a number above 0; correct the header's last but one word";
    case TextFault::header_frames:
      return "the number of frames is not a whole number; correct the header's last word";
    case TextFault::mask_flag:
      return "a flag is neither 0 nor 1; check that flags and values alternate line by line";
    case TextFault::mask_columns:
      return "wrong number of flags; a .fap line has 68, a .bap line 186 or 296";
    case TextFault::not_a_number:
      return "not a number (or beyond 1e9); correct the value";
    case TextFault::value_count:
      return "values do not match the flags; write the frame's number and one value per flag 1 "
             "(4 for FAP 1, 6 for FAP 2)";
    case TextFault::cut_off:
      return "the text ends within a frame; remove or complete the frame";
    case TextFault::viseme_field:
      return "FAP 1 is out of range; write viseme 0..14, viseme 0..14, blend 0..63, flag 0..1";
    case TextFault::expression_field:
      return "FAP 2 is out of range; write expression 0..6, intensity 0..63, twice, then two flags";
    case TextFault::out_of_room:
      return "the buffer for the text is too short; give a larger one";
  }
  return "unknown fault";
}

bool parse_number(std::span<const char> token, float* out) {
  std::size_t at = 0;
  bool negative = false;
  if (at < token.size() && (token[at] == '+' || token[at] == '-')) negative = token[at++] == '-';
  double value = 0.0;
  int digits = 0;
  int exponent = 0;
  bool fraction = false;
  for (; at < token.size(); ++at) {
    if (token[at] == '.' && !fraction) {
      fraction = true;
    } else if (is_digit(token[at])) {
      ++digits;
      if (value < 1e15) {
        value = value * 10.0 + (token[at] - '0');
        exponent -= fraction ? 1 : 0;
      } else {
        exponent += fraction ? 0 : 1;
      }
    } else {
      break;
    }
  }
  if (digits == 0) return false;
  if (at < token.size()) {
    int written = 0;
    if (token[at] != 'e' && token[at] != 'E') return false;
    if (!parse_exponent(token, at + 1, &written)) return false;
    exponent += written;
  }
  exponent = std::clamp(exponent, -60, 60);
  for (; exponent > 0; --exponent) value *= 10.0;
  for (; exponent < 0; ++exponent) value /= 10.0;
  if (value > static_cast<double>(kLargestNumber)) return false;
  *out = static_cast<float>(negative ? -value : value);
  return true;
}

void TextFrameReader::refill(std::span<const char> text, bool complete) {
  text_ = text;
  complete_ = complete;
  position_ = committed_ = 0;
  line_ = committed_line_;
}

// The next word, over line ends and comments; false at the end of the text.
bool TextFrameReader::next_token(Token* out) {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '#') {
      while (position_ < text_.size() && text_[position_] != '\n') ++position_;
    } else if (c == '\n') {
      ++line_;
      ++position_;
    } else if (is_blank(c)) {
      ++position_;
    } else {
      break;
    }
  }
  const std::size_t begin = position_;
  while (position_ < text_.size() && text_[position_] != '\n' && !is_blank(text_[position_]))
    ++position_;
  *out = {text_.data() + begin, position_ - begin};
  return position_ > begin;
}

bool TextFrameReader::is_known(std::size_t columns) const {
  return std::find(layout_.columns.begin(), layout_.columns.end(), columns) !=
         layout_.columns.end();
}

// True when no word follows on this line. The line end itself is not passed.
bool TextFrameReader::line_ends() {
  while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  return position_ == text_.size() || text_[position_] == '\n' || text_[position_] == '#';
}

Status TextFrameReader::fail(TextFault fault) {
  fault_ = status_of(Code::corrupt_data, fault);
  return fault_;
}

// The text ended where more must follow: later, when it arrives in pieces, else it is a fault.
Status TextFrameReader::end_inside(TextFault fault_if_complete) {
  if (!complete_) return status_of(Code::not_ready, TextFault::need_more);
  return fail(fault_if_complete);
}

Status TextFrameReader::read_header() {
  if (has_header_) return {};
  if (!fault_.ok()) return fault_;
  position_ = committed_;
  line_ = committed_line_;
  CARYATID_TRY(parse_header());
  has_header_ = true;
  committed_ = position_;
  committed_line_ = line_;
  return {};
}

// Words of the line: the first is the version, the last two are rate and count, the name is what
// stands between.
Status TextFrameReader::parse_header() {
  Token first, last_but_one, last, word;
  if (!next_token(&first)) return end_inside(TextFault::header_short);
  report_line_ = line_;
  int words = 1;
  while (!line_ends() && next_token(&word)) {
    last_but_one = last;
    last = word;
    ++words;
  }
  if (out_of_text()) return end_inside(TextFault::header_short);
  if (words < 3) return fail(TextFault::header_short);
  float frames = 0.0f;
  if (!parse_number({last_but_one.begin, last_but_one.size}, &header_.frames_per_second) ||
      !(header_.frames_per_second > 0.0f) || header_.frames_per_second > kLargestRate)
    return fail(TextFault::header_rate);
  if (!parse_number({last.begin, last.size}, &frames) || frames < 0.0f ||
      frames != static_cast<float>(static_cast<std::uint32_t>(frames)))
    return fail(TextFault::header_frames);
  header_.frame_count = static_cast<std::uint32_t>(frames);
  header_.version.assign({first.begin, first.size});
  const char* name = first.begin + first.size;
  while (name < last_but_one.begin && is_blank(*name)) ++name;
  const char* name_end = last_but_one.begin;
  while (name_end > name && is_blank(name_end[-1])) --name_end;
  header_.name.assign({name, static_cast<std::size_t>(name_end - name)});
  return {};
}

Status TextFrameReader::next(TextFrame* out) {
  CARYATID_TRY(read_header());
  if (!fault_.ok()) return fault_;
  position_ = committed_;
  line_ = committed_line_;
  CARYATID_TRY(parse_mask(out));
  CARYATID_TRY(parse_values(out));
  committed_ = position_;
  committed_line_ = line_;
  return {};
}

Status TextFrameReader::parse_mask(TextFrame* out) {
  out->mask.clear();
  out->columns = 0;
  Token word;
  if (!next_token(&word))
    return status_of(Code::not_ready, complete_ ? TextFault::end_of_text : TextFault::need_more);
  report_line_ = line_;
  while (true) {
    if (word.size != 1 || (*word.begin != '0' && *word.begin != '1')) {
      // A number that is no flag, on a later line: it is the flags that were too few.
      return fail(line_ == report_line_ ? TextFault::mask_flag : TextFault::mask_columns);
    }
    if (++out->columns > kMaxTextColumns) return fail(TextFault::mask_columns);
    out->mask.set(out->columns, *word.begin == '1');
    if (line_ends()) {
      if (out_of_text()) return end_inside(TextFault::cut_off);
      if (is_known(out->columns)) return {};
    }
    if (!next_token(&word)) return end_inside(TextFault::mask_columns);
  }
}

Status TextFrameReader::parse_values(TextFrame* out) {
  const std::size_t compact = out->mask.count();
  std::size_t expanded = compact;
  if (layout_.expands_fields)
    expanded += (out->mask.test(1) ? 3u : 0u) + (out->mask.test(2) ? 5u : 0u);
  Token word;
  if (!next_token(&word)) return end_inside(TextFault::cut_off);
  report_line_ = line_;
  float index = 0.0f;
  // A word at the very end of a piece may go on in the next one.
  if (out_of_text()) return end_inside(TextFault::cut_off);
  if (!parse_number({word.begin, word.size}, &index)) return fail(TextFault::not_a_number);
  out->index = static_cast<std::int32_t>(index);
  out->value_count = 0;
  while (true) {
    if (line_ends()) {
      if (out_of_text()) return end_inside(TextFault::cut_off);
      if (out->value_count == compact || out->value_count == expanded) return {};
    }
    if (out->value_count == expanded) return fail(TextFault::value_count);
    if (!next_token(&word) || out_of_text()) return end_inside(TextFault::cut_off);
    if (!parse_number({word.begin, word.size}, &out->values[out->value_count])) {
      report_line_ = line_;
      return fail(TextFault::not_a_number);
    }
    ++out->value_count;
  }
}

void TextSink::put(char c) {
  if (size_ == out_.size()) {
    ok_ = false;
    return;
  }
  out_[size_++] = c;
}

void TextSink::put(std::span<const char> text) {
  for (const char c : text) put(c);
}

void TextSink::put_number(float value) {
  const double bounded =
      value == value ? static_cast<double>(std::clamp(value, -kLargestNumber, kLargestNumber))
                     : 0.0;
  put_integer(static_cast<std::int64_t>(bounded + (bounded < 0.0 ? -0.5 : 0.5)));
}

void TextSink::put_integer(std::int64_t value) {
  char digits[20];
  std::size_t count = 0;
  std::uint64_t rest = static_cast<std::uint64_t>(value < 0 ? -value : value);
  do {
    digits[count++] = static_cast<char>('0' + static_cast<int>(rest % 10));
    rest /= 10;
  } while (rest > 0);
  if (value < 0) put('-');
  while (count > 0) put(digits[--count]);
}

Result<std::size_t> write_text_header(const TextHeader& header, std::span<char> out) {
  TextSink sink(out);
  sink.put(header.version.span());
  sink.put(' ');
  sink.put(header.name.span());
  sink.put(' ');
  const auto hundredths =
      static_cast<std::int64_t>(static_cast<double>(header.frames_per_second) * 100.0 + 0.5);
  sink.put_integer(hundredths / 100);
  if (hundredths % 100 != 0) {
    sink.put('.');
    sink.put(static_cast<char>('0' + static_cast<int>(hundredths % 100 / 10)));
    sink.put(static_cast<char>('0' + static_cast<int>(hundredths % 10)));
  }
  sink.put(' ');
  sink.put_integer(header.frame_count);
  sink.put('\n');
  if (!sink.ok()) return {status_of(Code::out_of_capacity, TextFault::out_of_room), 0};
  return {{}, sink.size()};
}

}  // namespace caryatid::stream
