#include "core/scene/text.h"

#include <gtest/gtest.h>

#include <vector>

namespace caryatid::scene {
namespace {

// A word and the blank behind it, for each width.
std::vector<Run> words(std::initializer_list<int> widths) {
  std::vector<Run> out;
  for (const int w : widths) {
    Run word;
    word.width = w;
    out.push_back(word);
    Run blank;
    blank.width = 10;
    blank.blank = blank.break_after = true;
    out.push_back(blank);
  }
  return out;
}

TEST(BreakLines, FillsLinesAndDropsTheBlanksAtTheirEnds) {
  const auto runs = words({50, 50, 50});
  TextLines lines;
  break_lines(runs, 110, &lines);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].width, 110);
  EXPECT_EQ(lines[0].run_count, 3);
  EXPECT_EQ(lines[1].first_run, 4);
  EXPECT_EQ(lines[1].width, 50);
}

TEST(BreakLines, NoLineIsWiderThanAskedUnlessAWordIs) {
  const auto runs = words({30, 200, 5, 60, 44, 90});
  TextLines lines;
  break_lines(runs, 100, &lines);
  std::size_t words_seen = 0;
  for (const TextLine& line : lines) {
    EXPECT_TRUE(line.width <= 100 || line.run_count == 1);
    for (int r = 0; r < line.run_count; ++r)
      words_seen += runs[line.first_run + static_cast<std::size_t>(r)].blank ? 0u : 1u;
  }
  EXPECT_EQ(words_seen, 6u);
}

TEST(BreakLines, AMustBreakEndsALineEvenIfThereIsRoom) {
  auto runs = words({10, 10});
  runs[1].must_break_after = true;
  TextLines lines;
  break_lines(runs, 1000, &lines);
  EXPECT_EQ(lines.size(), 2u);
  break_lines({}, 1000, &lines);
  EXPECT_EQ(lines.size(), 0u);
}

std::vector<std::uint16_t> order(std::initializer_list<int> levels) {
  std::vector<Run> line;
  for (const int l : levels) {
    line.emplace_back();
    line.back().level = static_cast<std::uint8_t>(l);
  }
  std::vector<std::uint16_t> out(line.size());
  visual_order(line, out);
  return out;
}

// Rule L2 of UAX 9, on its own kind of examples.
TEST(VisualOrder, TurnsRunsByTheirLevels) {
  using V = std::vector<std::uint16_t>;
  EXPECT_EQ(order({0, 0, 0}), (V{0, 1, 2}));
  EXPECT_EQ(order({1, 1, 1}), (V{2, 1, 0}));
  EXPECT_EQ(order({0, 1, 1, 0}), (V{0, 2, 1, 3}));
  EXPECT_EQ(order({1, 2, 2, 1}), (V{3, 1, 2, 0}));  // A number of two words in Hebrew.
  EXPECT_EQ(order({}), V{});
}

}  // namespace
}  // namespace caryatid::scene
