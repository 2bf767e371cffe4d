#include "core/agent/debounce.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/random.h"

namespace caryatid::agent {
namespace {

constexpr std::int64_t kMs = 1000;

// Feeds edges and collects what comes out, frame by frame.
class DebounceTest : public testing::Test {
 protected:
  void edge(bool pressed, std::int64_t time_us, std::uint16_t button = 1) {
    ASSERT_TRUE(debouncer_.feed({button, pressed, time_us}, &signals_).ok());
    collect();
  }
  void advance(std::int64_t now_us) {
    debouncer_.advance(now_us, &signals_);
    collect();
  }
  void collect() {
    for (const ButtonSignal& s : signals_) all_.push_back(s);
    signals_.clear();
  }
  std::vector<std::int64_t> times(ButtonAction action) const {
    std::vector<std::int64_t> found;
    for (const ButtonSignal& s : all_)
      if (s.action == action) found.push_back(s.time_us);
    return found;
  }

  Debouncer debouncer_;
  ButtonSignals signals_;
  std::vector<ButtonSignal> all_;
};

using Times = std::vector<std::int64_t>;

TEST_F(DebounceTest, FirstEdgeActsAtOnceAndBounceIsDropped) {
  edge(true, 100 * kMs);
  EXPECT_EQ(times(ButtonAction::pressed), Times{100 * kMs});
  edge(false, 100 * kMs + 300);
  edge(true, 100 * kMs + 900);
  edge(false, 102 * kMs);
  edge(true, 103 * kMs);
  advance(150 * kMs);
  EXPECT_EQ(times(ButtonAction::pressed).size(), 1u);
  EXPECT_TRUE(times(ButtonAction::released).empty());
  EXPECT_EQ(debouncer_.counts(1).accepted_edges, 1u);
  EXPECT_EQ(debouncer_.counts(1).rejected_edges, 4u);
}

TEST_F(DebounceTest, ATapShorterThanTheLockoutIsReleasedWhenItEnds) {
  edge(true, 0);
  edge(false, 4 * kMs);
  advance(9 * kMs);
  EXPECT_TRUE(debouncer_.is_pressed(1));
  advance(16 * kMs);
  EXPECT_FALSE(debouncer_.is_pressed(1));
  EXPECT_EQ(times(ButtonAction::released), Times{10 * kMs});
}

TEST_F(DebounceTest, ALostEdgeIsNoSecondPress) {
  edge(true, 0);
  edge(true, 50 * kMs);
  EXPECT_EQ(times(ButtonAction::pressed).size(), 1u);
  EXPECT_EQ(debouncer_.counts(1).rejected_edges, 1u);
}

TEST_F(DebounceTest, LongPressIsSentOnceAtItsTime) {
  edge(true, 10 * kMs);
  advance(809 * kMs);
  EXPECT_TRUE(times(ButtonAction::held).empty());
  advance(2000 * kMs);
  advance(4000 * kMs);
  EXPECT_EQ(times(ButtonAction::held), Times{810 * kMs});
  edge(false, 4100 * kMs);
  EXPECT_EQ(times(ButtonAction::released), Times{4100 * kMs});
}

TEST_F(DebounceTest, AShortPressIsNotLongEvenIfNoFrameFellBetween) {
  edge(true, 0);
  edge(false, 300 * kMs);
  advance(5000 * kMs);
  EXPECT_TRUE(times(ButtonAction::held).empty());
}

TEST_F(DebounceTest, ALongPressSeenOnlyAtItsReleaseIsStillReportedBeforeIt) {
  edge(true, 0);
  edge(false, 900 * kMs);
  ASSERT_EQ(all_.size(), 3u);
  EXPECT_EQ(all_[1].action, ButtonAction::held);
  EXPECT_EQ(all_[2].action, ButtonAction::released);
}

TEST_F(DebounceTest, PairsOfPressesAreDoubleAndAThirdBeginsAnew) {
  for (const std::int64_t ms : {0, 200, 400, 600}) {
    edge(true, ms * kMs);
    edge(false, (ms + 80) * kMs);
  }
  EXPECT_EQ(times(ButtonAction::pressed).size(), 4u);
  EXPECT_EQ(times(ButtonAction::pressed_twice), (Times{200 * kMs, 600 * kMs}));
}

TEST_F(DebounceTest, SlowPressesAreNotDouble) {
  edge(true, 0);
  edge(false, 80 * kMs);
  edge(true, 400 * kMs);
  EXPECT_TRUE(times(ButtonAction::pressed_twice).empty());
}

TEST_F(DebounceTest, ButtonsAreIndependent) {
  edge(true, 0, 1);
  edge(true, 1 * kMs, 2);
  edge(false, 30 * kMs, 1);
  EXPECT_FALSE(debouncer_.is_pressed(1));
  EXPECT_TRUE(debouncer_.is_pressed(2));
}

TEST_F(DebounceTest, TimeThatRunsBackwardsDoesNotUnlockOrRepeat) {
  edge(true, 1000 * kMs);
  edge(false, 5 * kMs);  // Counts as now: inside the lockout.
  EXPECT_TRUE(debouncer_.is_pressed(1));
  advance(0);
  EXPECT_TRUE(debouncer_.is_pressed(1));
  advance(1020 * kMs);
  EXPECT_FALSE(debouncer_.is_pressed(1));
}

TEST_F(DebounceTest, WrongArgumentsAreRefused) {
  EXPECT_EQ(debouncer_.feed({0, true, 0}, &signals_).code, Code::invalid_argument);
  EXPECT_EQ(debouncer_.feed({kMaxButtons + 1, true, 0}, &signals_).code, Code::invalid_argument);
  EXPECT_EQ(debouncer_.set_timing(0, {}).code, Code::invalid_argument);
  EXPECT_EQ(debouncer_.set_timing(1, {.lockout_us = -1}).code, Code::invalid_argument);
  EXPECT_TRUE(debouncer_.set_timing(kMaxButtons, {.lockout_us = 0}).ok());
  EXPECT_FALSE(debouncer_.is_pressed(0));
}

TEST_F(DebounceTest, OverflowIsCountedAndTheStateStaysRight) {
  ASSERT_TRUE(debouncer_.set_timing(1, {0, 0, 0}).ok());
  bool pressed = false;
  for (std::size_t i = 0; i < ButtonSignals::capacity() + 7; ++i) {
    pressed = !pressed;
    ASSERT_TRUE(debouncer_.feed({1, pressed, static_cast<std::int64_t>(i)}, &signals_).ok());
  }
  EXPECT_EQ(debouncer_.dropped_signals(), 7u);
  EXPECT_EQ(debouncer_.is_pressed(1), pressed);
}

TEST(ButtonSignal, OnlyPressAndReleaseAreEventsForTheAgent) {
  ButtonEvent event;
  ASSERT_TRUE(as_event({3, ButtonAction::pressed, 5}, &event));
  EXPECT_TRUE(event.button == 3 && event.pressed && event.time_us == 5);
  ASSERT_TRUE(as_event({3, ButtonAction::released, 6}, &event));
  EXPECT_FALSE(event.pressed);
  EXPECT_FALSE(as_event({3, ButtonAction::held, 7}, &event));
  EXPECT_FALSE(as_event({3, ButtonAction::pressed_twice, 7}, &event));
}

// Property: whatever a train of clean presses is dressed up with (bounce of up to 8 ms at each
// edge, frames of any length), each press comes out once, at its first edge, and each release once.
TEST_F(DebounceTest, AnyBounceTrainGivesExactlyThePresses) {
  Random random(7);
  Times presses, releases;
  std::int64_t now_us = 0;
  const auto pause = [&](std::int64_t least_us, std::int64_t most_us) {
    now_us += least_us + static_cast<std::int64_t>(random.next() %
                                                   static_cast<std::uint64_t>(most_us - least_us));
  };
  const auto bouncing_edge = [&](bool pressed) {
    const std::int64_t end_us = now_us + 8 * kMs;
    edge(pressed, now_us);
    for (bool level = pressed;;) {
      pause(50, 1500);
      if (now_us >= end_us) {
        if (level != pressed) edge(pressed, end_us);
        now_us = end_us;
        return;
      }
      level = !level;
      edge(level, now_us);
      if (random.next() % 4 == 0) advance(now_us);
    }
  };
  for (int i = 0; i < 2000; ++i) {
    presses.push_back(now_us);
    bouncing_edge(true);
    pause(5 * kMs, 900 * kMs);
    releases.push_back(now_us);
    bouncing_edge(false);
    pause(5 * kMs, 900 * kMs);
    if (random.next() % 2 == 0) advance(now_us);
  }
  EXPECT_EQ(times(ButtonAction::pressed), presses);
  EXPECT_EQ(times(ButtonAction::released), releases);
}

// Property: for any edges at all, presses and releases alternate, never closer than the lockout,
// and after a quiet time the reported state is the line's.
TEST_F(DebounceTest, AnyEdgesKeepTheLockoutAndEndAtTheLinesLevel) {
  Random random(11);
  std::int64_t now_us = 0;
  bool level = false;
  std::uint32_t fed = 0;
  for (int i = 0; i < 20000; ++i) {
    now_us += static_cast<std::int64_t>(random.next() % (i % 100 == 0 ? 200 * kMs : 7 * kMs));
    level = random.next() % 2 == 0;
    edge(level, now_us);
    ++fed;
  }
  advance(now_us + 10 * kMs);
  EXPECT_EQ(debouncer_.is_pressed(1), level);
  const DebounceCounts counts = debouncer_.counts(1);
  EXPECT_EQ(counts.accepted_edges + counts.rejected_edges, fed);
  bool pressed = false;
  std::int64_t last_us = -10 * kMs;
  for (const ButtonSignal& s : all_) {
    ButtonEvent event;
    if (!as_event(s, &event)) continue;
    EXPECT_NE(event.pressed, pressed);
    EXPECT_GE(event.time_us - last_us, 10 * kMs);
    pressed = event.pressed;
    last_us = event.time_us;
  }
}

}  // namespace
}  // namespace caryatid::agent
