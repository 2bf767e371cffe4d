#pragma once
#include <memory>

#include "platform/display/display.h"

namespace caryatid::platform {

// A window on an X server (Wayland desktops bring one). Keys 1..9, also of the number pad, are
// buttons 1..9; Escape and q ask to close.
Status open_window(const DisplayOptions& options, std::unique_ptr<Display>& out,
                   ErrorLine& out_error);

}  // namespace caryatid::platform
