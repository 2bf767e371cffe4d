#pragma once
// kiosk.toml: which buttons there are and what they do. Read before memory is sealed.
#include <string>
#include <string_view>

#include "core/agent/programme.h"
#include "platform/buttons/gpio.h"
#include "platform/buttons/hid.h"

namespace caryatid::app {

struct Config {
  agent::Programme programme;
  // The devices that press the buttons, by their numbers from 1.
  FixedVector<platform::GpioLine, kMaxButtons> gpio;
  FixedVector<platform::HidDevice, platform::kMaxHidDevices> hid;
};

// Parses the text of a kiosk.toml. False: `out_error` is one line, "NAME:LINE: what; cure".
bool parse_config(std::string_view text, std::string_view name, Config* out,
                  std::string* out_error);

// The default programme, compiled in: assets/programme/kiosk.toml.
std::string_view default_config_text();

}  // namespace caryatid::app
