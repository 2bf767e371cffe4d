#pragma once
// The keys of kiosk.toml that tie a button to a device: gpio, key, code, bit, and [[hid]]; and
// those that say how it is pressed: long, double, long_ms, double_ms, lockout_ms.
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <string>

#include "firmware-app/config.h"

namespace caryatid::app {

// Why a value was refused: where it stands, what is wrong, what to do.
struct DeviceRefusal {
  const toml::node* where = nullptr;
  std::string what, cure;
};

// Reads the [[hid]] tables. Before the buttons, whose keys go to these devices.
bool read_hid_devices(const toml::table& root, Config* out, DeviceRefusal* out_refusal);
// Reads gpio, key, code and bit of one [[button]] table for button `number` (from 1).
bool read_button_devices(const toml::table& button, std::uint16_t number, Config* out,
                         DeviceRefusal* out_refusal);
// Reads the times of one button, and which other button it is when held long or pressed twice.
bool read_button_timing(const toml::table& button, std::uint16_t number, Config* out,
                        DeviceRefusal* out_refusal);

}  // namespace caryatid::app
