#include "firmware-app/last_state.h"

#include <gtest/gtest.h>

#include <string>

namespace caryatid::app {
namespace {

std::string example() {
  LastState state{41, 123456, true};
  char text[kLastStateBytes];
  return std::string(format_state(state, text));
}

TEST(LastState, ComesBackAsItWasWritten) {
  LastState back;
  ASSERT_TRUE(parse_state(example(), &back));
  EXPECT_EQ(back.starts, 41u);
  EXPECT_EQ(back.presses, 123456u);
  EXPECT_TRUE(back.running);
}

TEST(LastState, EveryCutAndEveryFlippedBitIsRefused) {
  const std::string whole = example();
  LastState back;
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_FALSE(parse_state(whole.substr(0, n), &back)) << n;
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::string bad = whole;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_FALSE(parse_state(bad, &back)) << bit;
  }
  EXPECT_EQ(back.starts, 0u);
}

TEST(LastState, TheLongestFits) {
  LastState state{~0ull, ~0ull, true};
  char text[kLastStateBytes];
  LastState back;
  ASSERT_TRUE(parse_state(format_state(state, text), &back));
  EXPECT_EQ(back.starts, ~0ull);
}

}  // namespace
}  // namespace caryatid::app
