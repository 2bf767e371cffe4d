#pragma once
// The way from a framebuffer to a screen: connector, CRTC, primary plane, mode.
#include <xf86drmMode.h>

#include <cstdint>

#include "core/base/fixed.h"
#include "core/base/status.h"
#include "platform/display/gbm/mode.h"

namespace caryatid::platform::gbm {

inline constexpr std::size_t kMaxModifiers = 64;

// Ids of a kernel object's properties; 0: the driver lacks it.
struct PropertyIds {
  std::uint32_t connector_crtc = 0;
  std::uint32_t crtc_active = 0, crtc_mode = 0;
  std::uint32_t plane_fb = 0, plane_crtc = 0;
  std::uint32_t plane_source[4] = {}, plane_target[4] = {};  // x, y, width, height.
};

struct Output {
  std::uint32_t connector = 0, crtc = 0;
  std::uint32_t plane = 0;  // 0 without atomic commits.
  FixedString<31> name;     // "HDMI-A-1"
  drmModeModeInfo mode{};
  PropertyIds ids;
  // Layouts of XRGB8888 that the plane scans out; empty: the driver doesn't say.
  FixedVector<std::uint64_t, kMaxModifiers> modifiers;
};

// Asks every connector anew (on a monitor's cable, some milliseconds) and plans the way to the
// first screen that is connected. not_ready (no_screen): none is. io (no_card): the card is gone.
// unsupported (no_screen): the screen is there but no CRTC or plane is free for it.
Status find_output(int card, bool atomic, const ModeWish& wish, Output& out);

// What the kernel knows without asking the screen: it is told of a hot-plug by interrupt and looks
// itself every 10 s where there is none. Cheap. False too when the card is gone.
bool still_connected(int card, std::uint32_t connector);

}  // namespace caryatid::platform::gbm
