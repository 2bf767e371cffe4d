#include "platform/display/display.h"

#include <cstdlib>

#include "platform/display/egl_context.h"
#include "platform/display/surfaceless/surfaceless.h"
#ifdef CARYATID_DISPLAY_WINDOW
#include "platform/display/window/window.h"
#endif

namespace caryatid::platform {
namespace {

Status not_built(const char* text, ErrorLine& out_error) {
  set_error(out_error, text);
  return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::not_built)};
}

Status try_window(const DisplayOptions& options, std::unique_ptr<Display>& out,
                  ErrorLine& out_error) {
#ifdef CARYATID_DISPLAY_WINDOW
  return open_window(options, out, out_error);
#else
  (void)options, (void)out;
  return not_built("this build has no window display; install libx11-dev and build again",
                   out_error);
#endif
}

Status try_automatic(const DisplayOptions& options, std::unique_ptr<Display>& out,
                     ErrorLine& out_error) {
  const char* server = std::getenv("DISPLAY");
  if (server != nullptr && server[0] != '\0' && try_window(options, out, out_error).ok()) return {};
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
  return not_built("this build has no drm display; use --display window or surfaceless", out_error);
}

}  // namespace caryatid::platform
