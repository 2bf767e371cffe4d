// The GPIO buttons, service and backend, over a fake libgpiod: built once for each API.
#include "platform/buttons/gpio.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string_view>

#include "tests/unit/platform/buttons/fake_gpio.h"

namespace caryatid::platform {
namespace {

using testing::FakeLine;
using testing::world;

#ifdef CARYATID_TEST_GPIOD_V2
constexpr bool kKernelDebounce = true;
#else
constexpr bool kKernelDebounce = false;
#endif

FixedString<63> text(std::string_view s) { return FixedString<63>(std::span(s.data(), s.size())); }

GpioLine line_named(std::size_t button, std::string_view name) {
  GpioLine line;
  line.button = static_cast<std::uint16_t>(button);
  line.line = text(name);
  return line;
}

class GpioTest : public ::testing::Test {
 protected:
  void SetUp() override {
    FakeLine sd, joy, sad, calm;
    sd.name = "ID_SD", joy.name = "JOY", sad.name = "SAD", calm.name = "CALM";
    world.chips.clear();
    world.chips.push_back({"/dev/gpiochip0", "gpiochip0", "soc", 0, {sd, joy}, 0});
    world.chips.push_back({"/dev/gpiochip2", "gpiochip2", "panel", 0, {sad, calm}, 0});
  }
  void TearDown() override {
    buttons_.reset();
    for (testing::FakeChip& chip : world.chips) {
      EXPECT_EQ(chip.open_count, 0) << chip.path << " was left open";
      for (FakeLine& line : chip.lines) EXPECT_FALSE(line.requested) << line.name;
    }
  }
  FakeLine& joy() { return world.chips.front().lines[1]; }
  FakeLine& sad() { return world.chips.back().lines[0]; }

  Status open(std::initializer_list<GpioLine> lines) {
    return open_gpio_buttons(std::span(lines.begin(), lines.size()), buttons_, error_);
  }
  void expect_refused(std::initializer_list<GpioLine> lines, GpioFault fault, const char* word) {
    const Status status = open(lines);
    EXPECT_FALSE(status.ok());
    EXPECT_EQ(status.detail, static_cast<std::uint16_t>(fault)) << error_.c_str();
    EXPECT_NE(std::string(error_.c_str()).find(word), std::string::npos) << error_.c_str();
    if (fault == GpioFault::bad_config) {
      EXPECT_EQ(buttons_, nullptr);
    } else {  // The kiosk goes on without it.
      ASSERT_NE(buttons_, nullptr);
      EXPECT_EQ(poll(0).code, Code::device_lost);
    }
    buttons_.reset();
  }
  Status poll(std::int64_t now_us) {
    events_.clear();
    return buttons_->poll(now_us, events_);
  }

  std::unique_ptr<Buttons> buttons_;
  ButtonEvents events_;
  ErrorLine error_;
};

TEST_F(GpioTest, LinesAreFoundByNameOnAnyChip) {
  ASSERT_TRUE(open({line_named(1, "JOY"), line_named(2, "SAD")}).ok()) << error_.c_str();
  EXPECT_TRUE(joy().requested && joy().active_low);
  EXPECT_EQ(joy().bias, 1);
  EXPECT_TRUE(sad().requested);
}

TEST_F(GpioTest, LinesAreFoundByChipAndOffset) {
  GpioLine line;
  line.button = 3;
  line.offset = 1;
  line.active_low = false;
  line.bias = GpioBias::pull_down;
  for (const char* chip : {"panel", "gpiochip2", "/dev/gpiochip2"}) {
    line.chip = text(chip);
    ASSERT_TRUE(open({line}).ok()) << error_.c_str();
    const FakeLine& calm = world.chips.back().lines[1];
    EXPECT_TRUE(calm.requested && !calm.active_low) << chip;
    EXPECT_EQ(calm.bias, 2);
    buttons_.reset();
  }
}

TEST_F(GpioTest, EveryBiasReachesTheLine) {
  GpioLine line = line_named(1, "JOY");
  for (const auto& [bias, asked] :
       {std::pair{GpioBias::as_is, 0}, std::pair{GpioBias::disabled, -1},
        std::pair{GpioBias::pull_up, 1}}) {
    line.bias = bias;
    ASSERT_TRUE(open({line}).ok());
    EXPECT_EQ(joy().bias, asked);
    buttons_.reset();
  }
}

TEST_F(GpioTest, EdgesBecomeEventsWithTheKernelsTime) {
  ASSERT_TRUE(open({line_named(1, "JOY"), line_named(2, "SAD")}).ok());
  joy().edge(true, 1000);
  sad().edge(true, 1500);
  joy().edge(false, 2000);
  ASSERT_TRUE(poll(5000).ok());
  ASSERT_EQ(events_.size(), 3u);
  EXPECT_TRUE(events_[0].button == 1 && events_[0].pressed && events_[0].time_us == 1000);
  EXPECT_TRUE(events_[1].button == 1 && !events_[1].pressed && events_[1].time_us == 2000);
  EXPECT_TRUE(events_[2].button == 2 && events_[2].pressed && events_[2].time_us == 1500);
  ASSERT_TRUE(poll(6000).ok());
  EXPECT_TRUE(events_.empty());
}

TEST_F(GpioTest, MissingChip) {
  GpioLine line;
  line.button = 1;
  line.chip = text("gpiochip9");
  expect_refused({line}, GpioFault::no_chip, "gpiochip9");
}

TEST_F(GpioTest, AChipThatComesLateIsUsed) {
  world.chips.front().open_errno = ENODEV;
  EXPECT_FALSE(open({line_named(1, "JOY")}).ok());
  EXPECT_EQ(poll(0).code, Code::device_lost);
  world.chips.front().open_errno = 0;
  EXPECT_EQ(poll(100'000).code, Code::device_lost) << "before the pause is over";
  EXPECT_TRUE(poll(1'000'000).ok());
  joy().edge(true, 1'000'100);
  EXPECT_TRUE(poll(1'100'000).ok());
  EXPECT_EQ(events_.size(), 1u);
}

TEST_F(GpioTest, MissingLineReleasesTheOthers) {
  expect_refused({line_named(1, "JOY"), line_named(2, "NOWHERE")}, GpioFault::no_line, "NOWHERE");
  GpioLine line = line_named(1, "NOWHERE");
  line.chip = text("panel");
  expect_refused({line}, GpioFault::no_line, "NOWHERE");
  line.line = {};
  line.offset = 77;
  line.bias = GpioBias::as_is;
  expect_refused({line}, GpioFault::no_line, "panel");
}

TEST_F(GpioTest, BusyLine) {
  joy().request_errno = EBUSY;
  expect_refused({line_named(1, "JOY")}, GpioFault::busy, "in use");
}

TEST_F(GpioTest, ForbiddenChipNamesTheGroup) {
  for (testing::FakeChip& chip : world.chips) chip.open_errno = EACCES;
  expect_refused({line_named(1, "JOY")}, GpioFault::no_permission, "group gpio");
  GpioLine line = line_named(1, "JOY");
  line.chip = text("gpiochip0");
  expect_refused({line}, GpioFault::no_permission, "group gpio");
}

TEST_F(GpioTest, BiasThatTheChipLacks) {
  joy().request_errno = EINVAL;
  expect_refused({line_named(1, "JOY")}, GpioFault::no_bias, "as-is");
}

TEST_F(GpioTest, OtherErrorsKeepTheirReason) {
  joy().request_errno = EIO;
  expect_refused({line_named(1, "JOY")}, GpioFault::other, "Input/output error");
}

TEST_F(GpioTest, KernelDebounceIsPassedOnOrRefused) {
  GpioLine line = line_named(1, "JOY");
  line.kernel_debounce_us = 5000;
  if (kKernelDebounce) {
    ASSERT_TRUE(open({line}).ok());
    EXPECT_EQ(joy().debounce_us, 5000u);
  } else {
    expect_refused({line}, GpioFault::no_debounce, "1.6");
  }
}

TEST_F(GpioTest, WrongConfigurationIsRefusedBeforeAnyLineIsTaken) {
  expect_refused({line_named(0, "JOY")}, GpioFault::bad_config, "from 1 to 16");
  expect_refused({line_named(kMaxButtons + 1, "JOY")}, GpioFault::bad_config, "from 1 to 16");
  GpioLine nowhere;
  nowhere.button = 1;
  expect_refused({nowhere}, GpioFault::bad_config, "line name");
}

TEST_F(GpioTest, ALevelBehindLostEdgesIsCorrected) {
  ASSERT_TRUE(open({line_named(1, "JOY")}).ok());
  joy().lose_edge(true);
  joy().lose_edge(false);
  for (int i = 0; i < 15; ++i) joy().edge(i % 2 == 0, 100 + i);
  joy().edge(true, 200);
  joy().level = 0;  // The last edge seen is a press, but the line rests.
  ASSERT_TRUE(poll(5000).ok());
  ASSERT_EQ(events_.size(), 17u);
  EXPECT_TRUE(events_[15].pressed);
  EXPECT_TRUE(!events_[16].pressed && events_[16].time_us == 5000);
}

TEST_F(GpioTest, AnInterruptedReadIsNoLoss) {
  ASSERT_TRUE(open({line_named(1, "JOY")}).ok());
  joy().edge(true, 100);
  joy().read_errno = EAGAIN;
  EXPECT_TRUE(poll(1000).ok());
  joy().read_errno = 0;
  EXPECT_TRUE(poll(2000).ok());
  EXPECT_EQ(events_.size(), 1u);
}

TEST_F(GpioTest, ALostChipReleasesItsButtonsAndComesBack) {
  ASSERT_TRUE(open({line_named(1, "JOY"), line_named(2, "SAD")}).ok());
  joy().edge(true, 100);
  ASSERT_TRUE(poll(1000).ok());
  joy().edge(false, 1500);
  joy().read_errno = ENODEV;
  EXPECT_EQ(poll(2000).code, Code::device_lost);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_TRUE(events_[0].button == 1 && !events_[0].pressed && events_[0].time_us == 2000);

  joy().read_errno = 0;
  world.chips.front().open_errno = ENODEV;  // Still unplugged at the first try.
  EXPECT_EQ(poll(100'000).code, Code::device_lost);
  EXPECT_EQ(poll(260'000).code, Code::device_lost);
  world.chips.front().open_errno = 0;
  EXPECT_EQ(poll(300'000).code, Code::device_lost);  // Not before twice the pause.
  EXPECT_TRUE(poll(800'000).ok());
  joy().edge(true, 800'100);
  EXPECT_TRUE(poll(900'000).ok());
  EXPECT_EQ(events_.size(), 1u);
}

TEST_F(GpioTest, AHangUpIsALoss) {
  ASSERT_TRUE(open({line_named(1, "JOY")}).ok());
  ::close(joy().write_end);
  joy().write_end = -1;
  EXPECT_EQ(poll(1000).code, Code::device_lost);
}

TEST_F(GpioTest, ABurstOfAllLinesComesInPieces) {
  ASSERT_TRUE(open({line_named(1, "JOY"), line_named(2, "SAD")}).ok());
  for (int i = 0; i < 15; ++i) joy().edge(i % 2 == 0, 100 + i);
  for (int i = 0; i < 15; ++i) sad().edge(i % 2 == 0, 100 + i);
  ASSERT_TRUE(poll(1000).ok());
  EXPECT_EQ(events_.size(), 15u + 15u);
}

TEST_F(GpioTest, WhatDoesNotFitWaitsForTheNextPoll) {
  ASSERT_TRUE(open({line_named(1, "JOY"), line_named(2, "SAD")}).ok());
  for (int i = 0; i < 16; ++i) joy().edge(i % 2 == 0, 100 + i);
  for (int i = 0; i < 16; ++i) sad().edge(i % 2 == 0, 100 + i);
  ASSERT_TRUE(poll(1000).ok());
  EXPECT_EQ(events_.size(), 16u);
  ASSERT_TRUE(poll(2000).ok());
  EXPECT_EQ(events_.size(), 16u);
}

}  // namespace
}  // namespace caryatid::platform
