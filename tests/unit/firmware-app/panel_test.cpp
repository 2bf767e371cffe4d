// The panel over devices that say what the test wants: times, long and double presses, and what is
// told of a device that is away.
#include "firmware-app/panel.h"

#include <gtest/gtest.h>

#include <vector>

namespace caryatid::platform {
namespace {

// What the fake devices bring at the next poll.
struct World {
  ButtonEvents gpio, hid;
  Status gpio_status, hid_status;
} world;

class FakeButtons final : public Buttons {
 public:
  FakeButtons(ButtonEvents* events, Status* status) : events_(events), status_(status) {}
  Status poll(std::int64_t, ButtonEvents& out) override {
    for (const ButtonEvent& e : *events_) (void)out.push(e);
    events_->clear();
    return *status_;
  }

 private:
  ButtonEvents* events_;
  Status* status_;
};

}  // namespace

Status open_gpio_buttons(std::span<const GpioLine>, std::unique_ptr<Buttons>& out, ErrorLine&) {
  out = std::make_unique<FakeButtons>(&world.gpio, &world.gpio_status);
  return {};
}
Status open_hid_buttons(std::span<const HidDevice>, HidSearch, std::unique_ptr<Buttons>& out,
                        ErrorLine&) {
  out = std::make_unique<FakeButtons>(&world.hid, &world.hid_status);
  return {};
}

namespace {

using app::Panel;

class PanelTest : public ::testing::Test {
 protected:
  void SetUp() override { world = {}; }
  void open(const std::string& toml) {
    std::string error;
    app::Config config;
    ASSERT_TRUE(app::parse_config(toml, "kiosk.toml", &config, &error)) << error;
    ASSERT_TRUE(panel_.open(config, &error)) << error;
  }
  void edge(std::uint16_t button, bool down, std::int64_t ms) {
    ASSERT_TRUE(world.gpio.push({button, down, ms * 1000}));
  }
  // "+1 -1": button 1 pressed and released.
  std::string poll(std::int64_t ms) {
    ButtonEvents events;
    panel_.poll(ms * 1000, events);
    std::string out;
    for (const ButtonEvent& e : events)
      out +=
          (out.empty() ? "" : " ") + std::string(e.pressed ? "+" : "-") + std::to_string(e.button);
    return out;
  }
  std::string told(std::int64_t ms) {
    ::testing::internal::CaptureStderr();
    (void)poll(ms);
    return ::testing::internal::GetCapturedStderr();
  }
  Panel panel_;
};

constexpr const char* kThree =
    "[[button]]\nname='a'\ngpio='X'\n[[button]]\nname='b'\nlong='a'\n"
    "[[button]]\nname='c'\ndouble='a'\n";

TEST_F(PanelTest, ALongPressIsAnotherButton) {
  open(kThree);
  edge(1, true, 1000);
  EXPECT_EQ(poll(1000), "+1");
  EXPECT_EQ(poll(1790), "");
  EXPECT_EQ(poll(1810), "+2 -2");
  EXPECT_EQ(poll(3000), "") << "once a press";
  edge(1, false, 3010);
  EXPECT_EQ(poll(3010), "-1");
}

TEST_F(PanelTest, ADoublePressIsAnotherButton) {
  open(kThree);
  edge(1, true, 1000);
  edge(1, false, 1100);
  EXPECT_EQ(poll(1120), "+1 -1");
  edge(1, true, 1300);
  EXPECT_EQ(poll(1300), "+1 +3 -3");
}

TEST_F(PanelTest, TimesAreTheButtonsOwn) {
  open(
      "[[button]]\nname='a'\ngpio='X'\nlockout_ms=200\nlong_ms=2000\n"
      "[[button]]\nname='b'\nlong='a'\n[[button]]\nname='c'\ngpio='Y'\n");
  for (const std::int64_t ms : {0, 40, 80}) {
    edge(1, true, ms);
    edge(1, false, ms + 20);
  }
  for (const std::int64_t ms : {0, 40, 80}) {
    edge(3, true, ms);
    edge(3, false, ms + 20);
  }
  EXPECT_EQ(poll(100), "+1 +3 -3 +3 -3 +3 -3");
  EXPECT_EQ(panel_.rejected_edges(), 5u) << "of the button with the long lockout";
  EXPECT_EQ(poll(250), "-1");
}

TEST_F(PanelTest, SeveralButtonsAtOnce) {
  open(kThree);
  edge(1, true, 1000);
  ASSERT_TRUE(world.gpio.push({2, true, 1'001'000}));
  EXPECT_EQ(poll(1005), "+1 +2");
}

TEST_F(PanelTest, ADeviceThatIsAwayIsToldOnceWithItsReason) {
  open("[[hid]]\nvendor=1\nproduct=2\n[[button]]\nname='a'\nkey='a'\n");
  const auto fault = [](HidFault f) {
    return Status{Code::device_lost, static_cast<std::uint16_t>(f)};
  };
  world.hid_status = fault(HidFault::missing);
  EXPECT_NE(told(0).find("a USB button device is not there; waiting for it"), std::string::npos);
  EXPECT_EQ(told(33), "");
  EXPECT_TRUE(panel_.device_lost());
  world.hid_status = fault(HidFault::no_permission);
  EXPECT_NE(told(66).find("may not be opened; add the user to the group input"), std::string::npos);
  EXPECT_EQ(told(100), "");
  world.hid_status = {};
  EXPECT_NE(told(133).find("is there"), std::string::npos);
  EXPECT_FALSE(panel_.device_lost());
}

}  // namespace
}  // namespace caryatid::platform
