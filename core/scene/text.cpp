#include "core/scene/text.h"

#include <algorithm>

namespace caryatid::scene {
namespace {

// Ends the line in front of `end`; blanks at its end belong to no line.
void push_line(std::span<const Run> runs, std::size_t first, std::size_t end, TextLines* out) {
  TextLine line;
  line.first_run = static_cast<std::uint16_t>(first);
  while (end > first && runs[end - 1].blank) --end;
  line.run_count = static_cast<std::uint16_t>(end - first);
  for (std::size_t r = first; r < end; ++r) line.width += runs[r].width;
  (void)out->push(line);
}

}  // namespace

void break_lines(std::span<const Run> runs, std::int32_t max_width, TextLines* out) {
  out->clear();
  std::size_t first = 0;   // Of the line.
  std::size_t chance = 0;  // Runs in front of the last place to break; `first`: none yet.
  std::int32_t width = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Run& run = runs[r];
    width += run.width;
    if (width > max_width && !run.blank && chance > first) {
      push_line(runs, first, chance, out);
      first = chance;
      width = 0;
      for (std::size_t i = first; i <= r; ++i) width += runs[i].width;
    }
    if (run.break_after || run.must_break_after) chance = r + 1;
    if (run.must_break_after) {
      push_line(runs, first, r + 1, out);
      first = r + 1;
      width = 0;
    }
  }
  if (first < runs.size()) push_line(runs, first, runs.size(), out);
}

void visual_order(std::span<const Run> line, std::span<std::uint16_t> out) {
  std::uint8_t highest = 0, lowest_odd = 255;
  for (std::size_t r = 0; r < line.size(); ++r) {
    out[r] = static_cast<std::uint16_t>(r);
    highest = std::max(highest, line[r].level);
    if (line[r].level % 2 != 0) lowest_odd = std::min(lowest_odd, line[r].level);
  }
  for (int level = highest; level >= lowest_odd; --level)
    for (std::size_t first = 0; first < line.size();) {
      const auto in = [&](std::size_t i) { return line[out[i]].level >= level; };
      std::size_t end = first;
      while (end < line.size() && in(end)) ++end;
      std::reverse(out.begin() + static_cast<std::ptrdiff_t>(first),
                   out.begin() + static_cast<std::ptrdiff_t>(end));
      first = end + 1;
    }
}

}  // namespace caryatid::scene
