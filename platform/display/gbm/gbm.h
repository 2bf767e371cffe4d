#pragma once
// The screen of a board: DRM/KMS scans out what GL draws into GBM buffers.
//
// No screen at start, a pulled cable, another program that owns the card: the display stays open,
// is not visible(), and comes back by itself; each is told once on stderr. The GL context lives
// through all of them.
#include "platform/display/display.h"

namespace caryatid::platform {

// Waits up to 10 s for a card whose driver is still loading where `kind` is drm; with `automatic`
// fails at once where there is no card, no screen or another program has it.
Status open_gbm(const DisplayOptions& options, std::unique_ptr<Display>& out, ErrorLine& out_error);

}  // namespace caryatid::platform
