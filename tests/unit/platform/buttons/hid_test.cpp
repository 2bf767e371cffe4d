// The HID buttons over a fake hidapi.
#include "platform/buttons/hid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "core/base/random.h"
#include "tests/unit/platform/buttons/fake_hidapi.h"

namespace caryatid::platform {
namespace {

using testing::FakeHid;
using testing::hid_world;

constexpr std::uint8_t kA = 4, kB = 5, kEnter = 0x28;
constexpr std::int64_t kSettled_us = 1'000'000;

std::vector<std::uint8_t> boot_report(std::initializer_list<std::uint8_t> usages,
                                      std::uint8_t modifiers = 0) {
  std::vector<std::uint8_t> report(8);
  report[0] = modifiers;
  std::copy(usages.begin(), usages.end(), report.begin() + 2);
  return report;
}

HidKey key(std::uint16_t button, std::uint8_t usage) {
  HidKey k;
  k.button = button;
  k.usage = usage;
  return k;
}

HidKey code_key(std::uint16_t button, std::string_view code) {
  HidKey k;
  k.button = button;
  k.code.assign({code.data(), code.size()});
  return k;
}

HidDevice keyboard() {
  HidDevice device;
  device.vendor_id = 0x1234;
  device.product_id = 0x0001;
  EXPECT_TRUE(device.keys.push(key(1, kA)) && device.keys.push(key(2, kB)));
  return device;
}

class HidTest : public ::testing::Test {
 protected:
  void SetUp() override {
    hid_world = {};
    FakeHid device;
    device.path = "/dev/hidraw0";
    device.vendor_id = 0x1234;
    device.product_id = 0x0001;
    hid_world.devices.push_back(device);
  }
  void TearDown() override {
    buttons_.reset();
    for (const FakeHid& device : hid_world.devices) EXPECT_EQ(device.open_count, 0);
  }
  FakeHid& device() { return hid_world.devices.front(); }
  Status open(std::initializer_list<HidDevice> devices) {
    return open_hid_buttons(std::span(devices.begin(), devices.size()), HidSearch::in_poll,
                            buttons_, error_);
  }
  // Opened, and the settling time is over at kSettled_us.
  void open_settled(const HidDevice& wanted) {
    ASSERT_TRUE(open({wanted}).ok()) << error_.c_str();
    ASSERT_TRUE(poll(0).ok());
  }
  Status poll(std::int64_t now_us) {
    events_.clear();
    return buttons_->poll(now_us, events_);
  }
  void expect_event(std::size_t index, std::uint16_t button, bool pressed) {
    ASSERT_LT(index, events_.size());
    EXPECT_EQ(events_[index].button, button);
    EXPECT_EQ(events_[index].pressed, pressed);
  }

  std::unique_ptr<Buttons> buttons_;
  ButtonEvents events_;
  ErrorLine error_;
};

TEST_F(HidTest, KeysOfAKeyboard) {
  open_settled(keyboard());
  device().reports = {boot_report({kA}), boot_report({kA, kB}), boot_report({kB}), boot_report({})};
  ASSERT_TRUE(poll(kSettled_us).ok());
  ASSERT_EQ(events_.size(), 4u);
  expect_event(0, 1, true);
  expect_event(1, 2, true);
  expect_event(2, 1, false);
  expect_event(3, 2, false);
}

TEST_F(HidTest, ModifiersAreKeysToo) {
  HidDevice wanted = keyboard();
  ASSERT_TRUE(wanted.keys.push(key(3, 0xe1)));  // Left shift.
  open_settled(wanted);
  device().reports = {boot_report({}, 2)};
  ASSERT_TRUE(poll(kSettled_us).ok());
  expect_event(0, 3, true);
}

TEST_F(HidTest, UnmappedKeysTooManyKeysAndShortReportsDoNothing) {
  open_settled(keyboard());
  device().reports = {boot_report({30}), boot_report({1, 1, 1, 1, 1, 1}), {4}, {}, {0, 0}};
  ASSERT_TRUE(poll(kSettled_us).ok());
  EXPECT_TRUE(events_.empty());
}

TEST_F(HidTest, OnlyListedDevicesAreOpened) {
  FakeHid other = device();
  other.path = "/dev/hidraw1";
  other.product_id = 0x0666;
  hid_world.devices.push_back(other);
  open_settled(keyboard());
  EXPECT_EQ(hid_world.devices.back().open_count, 0);
  EXPECT_EQ(device().open_count, 1);
}

TEST_F(HidTest, UsageTellsInterfacesApart) {
  FakeHid second = device();
  second.path = "/dev/hidraw1";
  second.usage_page = 0x0c;
  second.usage = 1;
  hid_world.devices.push_back(second);
  HidDevice wanted = keyboard();
  wanted.usage_page = 1;
  wanted.usage = 6;
  open_settled(wanted);
  EXPECT_EQ(device().open_count, 1);
  EXPECT_EQ(hid_world.devices.back().open_count, 0);
}

TEST_F(HidTest, UnplugReleasesAndReplugWorksAgain) {
  open_settled(keyboard());
  device().reports = {boot_report({kA})};
  ASSERT_TRUE(poll(kSettled_us).ok());
  device().plugged = false;
  EXPECT_EQ(poll(2'000'000).code, Code::device_lost);
  ASSERT_EQ(events_.size(), 1u);
  expect_event(0, 1, false);
  EXPECT_EQ(device().open_count, 0);

  device().plugged = true;
  device().reports.clear();
  EXPECT_EQ(poll(2'100'000).code, Code::device_lost) << "before the pause is over";
  EXPECT_TRUE(poll(2'300'000).ok());
  device().reports = {boot_report({kB})};
  ASSERT_TRUE(poll(3'000'000).ok());
  expect_event(0, 2, true);
}

TEST_F(HidTest, AKeyThatIsDownAtPlugInMustBeReleasedFirst) {
  device().reports = {boot_report({kA})};
  ASSERT_TRUE(open({keyboard()}).ok());
  ASSERT_TRUE(poll(0).ok());
  EXPECT_TRUE(events_.empty());
  device().reports = {boot_report({kA, kB}), boot_report({kB}), boot_report({kA, kB})};
  ASSERT_TRUE(poll(kSettled_us).ok());
  ASSERT_EQ(events_.size(), 2u);
  expect_event(0, 2, true);
  expect_event(1, 1, true);
}

TEST_F(HidTest, AMissingDeviceIsLookedForLessAndLessOften) {
  device().plugged = false;
  ASSERT_TRUE(open({keyboard()}).ok());
  for (std::int64_t now_us = 0; now_us < 60'000'000; now_us += 33'333)
    EXPECT_EQ(poll(now_us).code, Code::device_lost);
  // 0, 0.25, 0.75, 1.75, 3.75, 7.75, 15.75 s, then every 8 s.
  EXPECT_GE(hid_world.searches, 11);
  EXPECT_LE(hid_world.searches, 13);
}

TEST_F(HidTest, AForbiddenDeviceSaysSo) {
  device().forbidden = true;
  ASSERT_TRUE(open({keyboard()}).ok());
  EXPECT_EQ(poll(0),
            (Status{Code::device_lost, static_cast<std::uint16_t>(HidFault::no_permission)}));
}

TEST_F(HidTest, BitsOfAButtonBoxBehindAReportId) {
  HidDevice box = keyboard();
  box.kind = HidKind::bits;
  box.report_id = 7;
  box.keys.clear();
  HidKey k;
  k.button = 9;
  k.byte = 1;
  k.bit = 3;
  ASSERT_TRUE(box.keys.push(k));
  open_settled(box);
  device().reports = {{7, 0, 8}, {5, 0, 0}, {7, 0}, {7, 0, 0xf7}};
  ASSERT_TRUE(poll(kSettled_us).ok());
  ASSERT_EQ(events_.size(), 2u);
  expect_event(0, 9, true);
  expect_event(1, 9, false);
}

class WedgeTest : public HidTest {
 protected:
  void SetUp() override {
    HidTest::SetUp();
    HidDevice wedge = keyboard();
    wedge.kind = HidKind::wedge;
    wedge.keys.clear();
    ASSERT_TRUE(wedge.keys.push(code_key(5, "ab10")));
    open_settled(wedge);
  }
  void type(std::initializer_list<std::uint8_t> usages) {
    for (const std::uint8_t usage : usages) {
      device().reports.push_back(boot_report({usage}));
      device().reports.push_back(boot_report({}));
    }
  }
};

TEST_F(WedgeTest, ACodeAndEnterIsAPress) {
  type({kA, kB, 0x1e, 0x27, kEnter});
  ASSERT_TRUE(poll(kSettled_us).ok());
  ASSERT_EQ(events_.size(), 2u);
  expect_event(0, 5, true);
  expect_event(1, 5, false);
}

TEST_F(WedgeTest, OtherCodesDoNothingAndLeaveNothingBehind) {
  type({kA, kB, 0x1e, kEnter});
  ASSERT_TRUE(poll(kSettled_us).ok());
  type({0x27, kEnter});
  ASSERT_TRUE(poll(kSettled_us + 1000).ok());
  EXPECT_TRUE(events_.empty());
}

TEST_F(WedgeTest, APauseBeginsANewCode) {
  type({kA});
  ASSERT_TRUE(poll(kSettled_us).ok());
  type({kA, kB, 0x1e, 0x27, kEnter});
  ASSERT_TRUE(poll(kSettled_us + 600'000).ok());
  EXPECT_EQ(events_.size(), 2u);
}

TEST_F(WedgeTest, AnOverlongCodeMatchesNothing) {
  for (int i = 0; i < 40; ++i) type({kA});
  type({kEnter});
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(poll(kSettled_us + i).ok());
    EXPECT_TRUE(events_.empty());
  }
}

TEST(Hid, WrongConfigurationsAreRefused) {
  std::unique_ptr<Buttons> buttons;
  ErrorLine error;
  HidDevice nobody;
  EXPECT_EQ(open_hid_buttons({&nobody, 1}, HidSearch::in_poll, buttons, error).code,
            Code::invalid_argument);
  HidDevice wrong_button = keyboard();
  ASSERT_TRUE(wrong_button.keys.push(key(0, 9)));
  EXPECT_EQ(open_hid_buttons({&wrong_button, 1}, HidSearch::in_poll, buttons, error).code,
            Code::invalid_argument);
  const std::vector<HidDevice> many(kMaxHidDevices + 1, keyboard());
  EXPECT_EQ(open_hid_buttons(many, HidSearch::in_poll, buttons, error).code,
            Code::invalid_argument);
  EXPECT_GT(error.size(), 0u);
}

TEST(Hid, WithoutHidapiTheErrorSaysSo) {
  hid_world = {};
  hid_world.init_result = -1;
  std::unique_ptr<Buttons> buttons;
  ErrorLine error;
  const HidDevice device = keyboard();
  EXPECT_EQ(open_hid_buttons({&device, 1}, HidSearch::in_poll, buttons, error).detail,
            static_cast<std::uint16_t>(HidFault::no_hidapi));
  EXPECT_EQ(buttons, nullptr);
  hid_world = {};
}

// Buttons that search beside the frames for a keyboard that is plugged in only after the start.
void open_then_plug(std::unique_ptr<Buttons>* out) {
  hid_world = {};
  FakeHid away;
  away.path = "/dev/hidraw0";
  away.vendor_id = 0x1234;
  away.product_id = 0x0001;
  away.plugged = false;
  hid_world.devices.push_back(away);
  ErrorLine error;
  const HidDevice wanted = keyboard();
  ASSERT_TRUE(open_hid_buttons({&wanted, 1}, HidSearch::beside_frames, *out, error).ok());
  hid_world.devices.front().plugged = true;
}

// A search that hangs inside hidapi, as while a hub starts: frames go on, and the device works when
// the search comes back.
TEST(Hid, NoFrameWaitsForASearch) {
  std::unique_ptr<Buttons> buttons;
  open_then_plug(&buttons);
  hid_world.hangs = true;
  ButtonEvents events;
  std::int64_t now_us = 0;
  const auto frame = [&] {
    now_us += 33'333;
    events.clear();
    return buttons->poll(now_us, events);
  };
  while (!hid_world.is_hanging) EXPECT_EQ(frame().code, Code::device_lost);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(frame().code, Code::device_lost);
  EXPECT_TRUE(hid_world.is_hanging) << "the search was waited for";
  hid_world.hangs = false;
  while (!frame().ok()) std::this_thread::yield();
  hid_world.devices.front().reports = {boot_report({}), boot_report({kA})};
  now_us += kSettled_us;
  EXPECT_TRUE(frame().ok());
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(events[0].pressed);
  buttons.reset();
  EXPECT_EQ(hid_world.devices.front().open_count, 0);
}

// What was found when nobody wants it any more is closed again.
TEST(Hid, AnAnswerThatNobodyTakesIsClosed) {
  std::unique_ptr<Buttons> buttons;
  open_then_plug(&buttons);
  ButtonEvents events;
  EXPECT_EQ(buttons->poll(0, events).code, Code::device_lost);
  EXPECT_EQ(buttons->poll(1'000'000, events).code, Code::device_lost);  // Asks.
  while (hid_world.opens == 0) std::this_thread::yield();
  buttons.reset();
  EXPECT_EQ(hid_world.devices.front().open_count, 0);
}

// Property: any bytes at all leave presses and releases alternating, and nothing pressed after the
// device is gone.
TEST(Hid, AnyReportsKeepPressesAndReleasesPaired) {
  Random random(3);
  HidDevice device = keyboard();
  HidReader reader(device);
  bool pressed[kMaxButtons + 1] = {};
  for (int i = 0; i < 20'000; ++i) {
    std::uint8_t report[9];
    for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(random.next() % 7);
    ButtonEvents events;
    if (i % 100 == 99)
      reader.release_all(i, events);
    else
      reader.feed(std::span(report).first(random.next() % 10), i, random.next() % 4 == 0, events);
    for (const ButtonEvent& e : events) {
      EXPECT_NE(pressed[e.button], e.pressed);
      pressed[e.button] = e.pressed;
    }
    EXPECT_FALSE(i % 100 == 99 && (pressed[1] || pressed[2]));
  }
}

}  // namespace
}  // namespace caryatid::platform
