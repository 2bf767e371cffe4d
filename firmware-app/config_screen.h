#pragma once
// The table [screen] of kiosk.toml.
#include "firmware-app/config_devices.h"

namespace caryatid::app {

// Reads [screen] of `root` where it is there.
bool read_screen(const toml::table& root, Config* out, DeviceRefusal* out_refusal);

}  // namespace caryatid::app
