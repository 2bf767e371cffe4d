#pragma once
// kiosk.toml: which buttons there are and which devices press them. What they do is compiled apart
// (texts/compile.h). Read before memory is sealed.
#include <array>
#include <string>
#include <string_view>

#include "core/agent/debounce.h"
#include "core/base/fixed.h"
#include "firmware-app/screen_care.h"
#include "platform/buttons/gpio.h"
#include "platform/buttons/hid.h"

namespace caryatid::app {

// What the buttons are called, in their order.
struct ButtonNames {
  FixedVector<FixedString<31>, kMaxButtons> names;
  // Index of the button, or -1. O(buttons).
  int find(std::string_view name) const;
};

// A button that is pressed by how another one is: held for long, or twice. The other one acts at
// its first edge all the same.
struct DerivedButton {
  std::uint16_t button = 0, of = 0;  // Numbers from 1.
  agent::ButtonAction action = agent::ButtonAction::held;
};

struct Config {
  ButtonNames buttons;
  std::array<agent::ButtonTiming, kMaxButtons> timings;  // By the button's number - 1.
  FixedVector<DerivedButton, kMaxButtons> derived;
  // The devices that press the buttons, by their numbers from 1.
  FixedVector<platform::GpioLine, kMaxButtons> gpio;
  FixedVector<platform::HidDevice, platform::kMaxHidDevices> hid;
  ScreenCareConfig screen;
};

// Parses the text of a kiosk.toml. False: `out_error` is one line, "NAME:LINE: what; cure".
bool parse_config(std::string_view text, std::string_view name, Config* out,
                  std::string* out_error);

}  // namespace caryatid::app
