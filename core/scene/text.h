#pragma once
// Text that is already shaped, broken into lines and put into drawing order. Shaping (HarfBuzz),
// break opportunities (Unicode UAX 14) and directions (UAX 9) were settled when the programme was
// compiled; what is left here is arithmetic.
//
// Units: 1/2048 of the em (pack::kUnitsPerEm). Glyphs stand in visual order, left to right.
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"

namespace caryatid::scene {

struct ShapedGlyph {
  std::uint16_t glyph;  // Index into the font pack's glyphs.
  std::int16_t advance;
  std::int16_t dx, dy;  // Of this glyph alone; dy upwards.
};
static_assert(sizeof(ShapedGlyph) == 8);

// A piece of text that is never broken: a word with its punctuation, or the blanks between two.
struct Run {
  std::span<const ShapedGlyph> glyphs;
  std::int32_t width = 0;
  std::uint16_t text_begin = 0, text_end = 0;  // Bytes of the text that it shows.
  std::uint8_t level = 0;         // Of the bidirectional algorithm: odd runs leftwards.
  bool break_after = false;       // A line may end behind it.
  bool must_break_after = false;  // It has to.
  bool blank = false;             // Does not count at the end of a line.
  bool emphasis = false;
};
using Runs = FixedVector<Run, kMaxRuns>;

struct TextLine {
  std::uint16_t first_run = 0, run_count = 0;  // Trailing blanks are in no line.
  std::int32_t width = 0;
};
using TextLines = FixedVector<TextLine, kMaxTextLines>;

// Breaks runs into lines of at most max_width where they may break; a run that is wider than a line
// gets a line of its own. Lines beyond the capacity are dropped. O(runs).
void break_lines(std::span<const Run> runs, std::int32_t max_width, TextLines* out);

// Index of each run of the line in the order in which it is drawn from left to right (rule L2 of
// UAX 9). out: at least run_count long. O(runs * levels).
void visual_order(std::span<const Run> line, std::span<std::uint16_t> out);

}  // namespace caryatid::scene
