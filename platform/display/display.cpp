#include "platform/display/display.h"

#include <cstdlib>
#include <iterator>

#include "platform/display/egl_context.h"
#include "platform/display/surfaceless/surfaceless.h"
#ifdef CARYATID_DISPLAY_GBM
#include "platform/display/gbm/gbm.h"
#endif
#ifdef CARYATID_DISPLAY_WAYLAND
#include "platform/display/wayland/wayland.h"
#endif
#ifdef CARYATID_DISPLAY_WINDOW
#include "platform/display/window/window.h"
#endif

namespace caryatid::platform {
namespace {

struct WindowSystem {
  const char* variable;  // Names the server where one runs.
  Status (*open)(const DisplayOptions&, std::unique_ptr<Display>&, ErrorLine&);
};

// In the order in which they are tried: an X server on a Wayland desktop is the longer way.
constexpr WindowSystem window_systems[] = {
#ifdef CARYATID_DISPLAY_WAYLAND
    {"WAYLAND_DISPLAY", open_wayland},
#endif
#ifdef CARYATID_DISPLAY_WINDOW
    {"DISPLAY", open_window},
#endif
    {nullptr, nullptr}};

Status not_built(const char* text, ErrorLine& out_error) {
  set_error(out_error, text);
  return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::not_built)};
}

// The first window system that answers; else what the last one that was named complained of.
Status try_window(const DisplayOptions& options, std::unique_ptr<Display>& out,
                  ErrorLine& out_error) {
  if (std::size(window_systems) == 1)
    return not_built("this build has no window display; see the packages of cross/host.sh",
                     out_error);
  set_error(out_error,
            "no window system here: WAYLAND_DISPLAY and DISPLAY are not set; "
            "use --display surfaceless");
  Status status{Code::io, static_cast<std::uint16_t>(DisplayFault::no_display_server)};
  for (const WindowSystem* system = window_systems; system->open != nullptr; ++system) {
    const char* server = std::getenv(system->variable);
    if (server == nullptr || server[0] == '\0') continue;
    status = system->open(options, out, out_error);
    if (status.ok()) break;
  }
  return status;
}

Status try_drm([[maybe_unused]] const DisplayOptions& options,
               [[maybe_unused]] std::unique_ptr<Display>& out, ErrorLine& out_error) {
#ifdef CARYATID_DISPLAY_GBM
  return open_gbm(options, out, out_error);
#else
  return not_built("this build has no drm display; see the packages of cross/host.sh", out_error);
#endif
}

Status try_automatic(const DisplayOptions& options, std::unique_ptr<Display>& out,
                     ErrorLine& out_error) {
  if (try_drm(options, out, out_error).ok()) return {};
  if (try_window(options, out, out_error).ok()) return {};
  return open_surfaceless(options, out, out_error);
}

}  // namespace

Status open_display(const DisplayOptions& options, std::unique_ptr<Display>& out,
                    ErrorLine& out_error) {
  out.reset();
  const auto sane = [](std::uint32_t pixels) { return pixels >= 16 && pixels <= 4096; };
  if (!sane(options.width) || !sane(options.height)) {
    set_error(out_error, "the display size must lie between 16x16 and 4096x4096");
    return {Code::invalid_argument, static_cast<std::uint16_t>(DisplayFault::bad_size)};
  }
  switch (options.kind) {
    case DisplayKind::automatic:
      return try_automatic(options, out, out_error);
    case DisplayKind::window:
      return try_window(options, out, out_error);
    case DisplayKind::surfaceless:
      return open_surfaceless(options, out, out_error);
    case DisplayKind::drm:
      break;
  }
  return try_drm(options, out, out_error);
}

}  // namespace caryatid::platform
