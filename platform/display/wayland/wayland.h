#pragma once
#include <memory>

#include "platform/display/display.h"

namespace caryatid::platform {

// A window on a Wayland compositor (xdg-shell); a kiosk compositor gives it the whole screen. Keys
// 1..9 of both rows of digits are buttons 1..9, Escape and q ask to close: by the place of the key,
// whatever letters a country prints there. A hidden window is not drawn and blocks nobody.
Status open_wayland(const DisplayOptions& options, std::unique_ptr<Display>& out,
                    ErrorLine& out_error);

}  // namespace caryatid::platform
