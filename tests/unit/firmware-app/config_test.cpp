// kiosk.toml: the keys that tie buttons to devices, and that every refusal names its line.
#include "firmware-app/config.h"

#include <gtest/gtest.h>

namespace caryatid::app {
namespace {

class ConfigTest : public ::testing::Test {
 protected:
  bool parse(const std::string& text) {
    error_.clear();
    return parse_config(text, "kiosk.toml", &config_, &error_);
  }
  // The text is refused with the line and the word in its error.
  void expect_refused(const std::string& text, const std::string& line, const std::string& word) {
    EXPECT_FALSE(parse(text)) << text;
    EXPECT_EQ(error_.rfind("kiosk.toml:" + line + ": ", 0), 0u) << error_;
    EXPECT_NE(error_.find(word), std::string::npos) << error_;
    EXPECT_EQ(error_.find('\n'), std::string::npos) << error_;
  }
  static std::string button(const std::string& more) {
    return "[[button]]\nname = 'a'\nfeel = 'joy'\n" + more + "\n";
  }

  Config config_;
  std::string error_;
};

const std::string kKeyboard = "[[hid]]\nvendor = 0x1234\nproduct = 1\n";

TEST_F(ConfigTest, AButtonNeedsNoDevice) {
  ASSERT_TRUE(parse(button(""))) << error_;
  EXPECT_TRUE(config_.gpio.empty() && config_.hid.empty());
}

TEST_F(ConfigTest, GpioByName) {
  ASSERT_TRUE(parse(button("") + "[[button]]\nname = 'b'\nfeel = 'fear'\ngpio = 'GPIO17'\n"));
  ASSERT_EQ(config_.gpio.size(), 1u);
  EXPECT_EQ(config_.gpio[0].button, 2u);
  EXPECT_STREQ(config_.gpio[0].line.c_str(), "GPIO17");
  EXPECT_TRUE(config_.gpio[0].active_low);
}

TEST_F(ConfigTest, GpioByChipAndOffset) {
  ASSERT_TRUE(
      parse(button("gpio = { chip = 'gpiochip0', offset = 3, bias = 'as-is', "
                   "active_low = false, debounce_us = 500 }")))
      << error_;
  const platform::GpioLine& line = config_.gpio[0];
  EXPECT_STREQ(line.chip.c_str(), "gpiochip0");
  EXPECT_EQ(line.offset, 3u);
  EXPECT_EQ(line.bias, platform::GpioBias::as_is);
  EXPECT_FALSE(line.active_low);
  EXPECT_EQ(line.kernel_debounce_us, 500u);
}

TEST_F(ConfigTest, WrongGpioIsRefusedWithItsLine) {
  expect_refused(button("gpio = 7"), "4", "neither a name nor a table");
  expect_refused(button("gpio = ''"), "4", "names no line");
  expect_refused(button("gpio = { chip = 'x' }"), "4", "names no line");
  expect_refused(button("gpio = { offset = 1 }"), "4", "names no line");
  expect_refused(button("gpio = { chip = 'x', offset = -1 }"), "4", "names no line");
  expect_refused(button("gpio = { line = 'x', bias = 'up' }"), "4", "pull-up");
  expect_refused(button("gpio = { line = 'x', debounce_us = -5 }"), "4", "debounce_us");
  expect_refused(button("gpio = { line = 'x', pull = 'up' }"), "4", "unknown key 'pull'");
}

TEST_F(ConfigTest, KeysGoToTheKeyboards) {
  ASSERT_TRUE(parse(kKeyboard + button("key = 'b'"))) << error_;
  ASSERT_EQ(config_.hid.size(), 1u);
  ASSERT_EQ(config_.hid[0].keys.size(), 1u);
  EXPECT_EQ(config_.hid[0].keys[0].usage, 5u);
  ASSERT_TRUE(parse(kKeyboard + button("key = 200")));
  EXPECT_EQ(config_.hid[0].keys[0].usage, 200u);
}

TEST_F(ConfigTest, CodesGoToReadersAndBitsToBoxes) {
  ASSERT_TRUE(parse(kKeyboard + "kind = 'reader'\n" + button("code = '12ab'"))) << error_;
  EXPECT_STREQ(config_.hid[0].keys[0].code.c_str(), "12ab");
  ASSERT_TRUE(parse(kKeyboard + "kind = 'box'\n" + button("bit = 10"))) << error_;
  EXPECT_EQ(config_.hid[0].keys[0].byte, 1u);
  EXPECT_EQ(config_.hid[0].keys[0].bit, 2u);
}

TEST_F(ConfigTest, WrongDevicesAreRefusedWithTheirLine) {
  expect_refused("[[hid]]\nvendor = 1\n" + button(""), "1", "vendor and product");
  expect_refused("[[hid]]\nvendor = 1\nproduct = 70000\n" + button(""), "1", "vendor and product");
  expect_refused(kKeyboard + "kind = 'mouse'\n" + button(""), "1", "keyboard, reader, box");
  expect_refused(kKeyboard + "colour = 'red'\n" + button(""), "4", "unknown key 'colour'");
  expect_refused("hid = 3\n" + button(""), "1", "[[hid]]");
  expect_refused(kKeyboard + button("key = '%'"), "7", "no key of a keyboard");
  expect_refused(kKeyboard + button("code = '12'"), "7", "no [[hid]] device");
  expect_refused(button("key = 'a'"), "4", "no [[hid]] device");
  expect_refused(kKeyboard + "kind = 'reader'\n" + button("code = 'A B'"), "8", "no code");
  expect_refused(kKeyboard + "kind = 'box'\n" + button("bit = 512"), "8", "no place");
}

TEST_F(ConfigTest, LongAndDoublePressesAreOfEarlierButtons) {
  const std::string two = "[[button]]\nname='a'\n[[button]]\nname='b'\n";
  expect_refused(two + "long='c'\n", "5", "no button that stands above");
  expect_refused(two + "double='b'\n", "5", "no button that stands above");
  expect_refused(two + "long_ms=-1\n", "5", "no time");
  expect_refused(two + "lockout_ms='x'\n", "5", "no time");
}

TEST_F(ConfigTest, TooManyDevicesAreRefused) {
  std::string many;
  for (std::size_t i = 0; i <= platform::kMaxHidDevices; ++i) many += kKeyboard;
  expect_refused(many + button(""), "13", "at most 4");
}

TEST_F(ConfigTest, TheScreensCare) {
  ASSERT_TRUE(parse(button("") + "[screen]\ndim_after_s = 60\noff_after_s = 600.5\nwander = 0\n"))
      << error_;
  EXPECT_EQ(config_.screen.dim_after_s, 60.0f);
  EXPECT_EQ(config_.screen.off_after_s, 600.5f);
  EXPECT_EQ(config_.screen.wander, 0.0f);
  expect_refused(button("") + "[screen]\ndim = 1\n", "6", "dim");
  expect_refused(button("") + "[screen]\nwander = 0.2\n", "6", "wander");
  expect_refused(button("") + "[screen]\ndim_to = 'half'\n", "6", "dim_to");
  expect_refused("screen = 1\n" + button(""), "1", "[screen]");
}

}  // namespace
}  // namespace caryatid::app
