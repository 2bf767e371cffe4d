#pragma once
// The service that owns the screen and the GL context drawn on. Backends: gbm (DRM/KMS, boards),
// wayland and window (X11), surfaceless (no screen: servers, CI, the tool).
//
// A display makes its context current on the thread that opened it and stays on that thread.
#include <cstdint>
#include <memory>

#include "core/base/status.h"
#include "platform/buttons/buttons.h"
#include "platform/error_line.h"

namespace caryatid::platform {

enum class DisplayKind : std::uint8_t { automatic, drm, window, surfaceless };

struct DisplayOptions {
  DisplayKind kind = DisplayKind::automatic;
  std::uint32_t width = 800, height = 480;  // Wish; 16..4096. A screen may have its own mind.
  std::uint8_t samples = 4;                 // Wish for multisampling of the surface; 0 none.
  // drm: the size was asked for; else the mode that the screen prefers counts.
  bool insists_on_size = false;
  bool legacy_kms = false;  // drm: no atomic mode setting, even where the driver offers it.
  const char* title = "Caryatid";
  bool times_gpu = true;  // Fill in Flip::gpu_us where the driver can; a replay has no use for it.
};

// Why a display did not open or stopped: Status::detail.
enum class DisplayFault : std::uint16_t {
  none,
  no_display_server,  // window: no Wayland compositor or X server answers.
  no_egl,             // EGL or the platform extension is missing.
  no_config,          // No usable framebuffer configuration.
  no_context,         // The driver refuses GLES 2.
  no_surface,
  not_built,  // This build lacks the backend.
  bad_size,
  context_lost,  // GPU reset or device gone: open display and renderer again.
  no_card,       // drm: no graphics card with connectors, or it may not be opened, or is gone.
  no_screen,     // drm: none is connected, or it refuses what it is given.
  not_master,    // drm: another program owns the screen.
  flip_lost,     // drm: the driver loses page flips: open display and renderer again.
};

// What the world outside did since the last poll.
struct DisplayEvents {
  ButtonEvents buttons;  // Keys 1..9 of a window as buttons 1..9.
  bool close_requested = false;
  bool resized = false;  // width() and height() are new; tell the renderer.
};

// The last picture that came on the screen.
struct Flip {
  std::uint64_t count = 0;      // Of all flips since the display was opened.
  std::int64_t time_us = 0;     // Monotonic, by the screen's own time stamp.
  std::uint16_t vblanks = 0;    // Refresh periods since the flip before; 0: unknown.
  std::uint32_t waited_us = 0;  // How long present() waited for it, with nothing to do.
  // How long the GPU went on with it after the last GL call (see gpu_timer.h).
  std::uint32_t gpu_us = kNotTimed;
  static constexpr std::uint32_t kNotTimed = 0xffffffffu;
};

using GlProc = void (*)();

class Display {
 public:
  virtual ~Display() = default;
  virtual const char* name() const = 0;
  virtual std::uint32_t width() const = 0;
  virtual std::uint32_t height() const = 0;
  // False: there is no framebuffer 0; the renderer draws into one of its own.
  virtual bool has_surface() const = 0;
  // A GL function that is not in GLES 2.0, or nullptr.
  virtual GlProc proc_address(const char* gl_name) const = 0;
  // Collects events without blocking.
  virtual Status poll(std::int64_t now_us, DisplayEvents& out) = 0;
  // Shows what was drawn; on a screen waits for the next refresh where the driver does.
  // device_lost (context_lost, flip_lost): everything on the GPU is gone.
  virtual Status present() = 0;
  // count stays 0 where the display counts no refreshes; waited_us and gpu_us are there all the
  // same.
  virtual Flip last_flip() const { return {}; }
  // Time between two refreshes of the screen; 0: the display can't tell.
  virtual std::int64_t refresh_us() const { return 0; }
  // False: nobody can see a picture now (no screen, screen off): drawing is wasted.
  virtual bool visible() const { return true; }
  // Screen off and on again, where the display can.
  virtual void set_power(bool /*on*/) {}
};

// Opens the display asked for; `window` is Wayland where WAYLAND_DISPLAY is set, else or when that
// fails X11 where DISPLAY is; `automatic` tries drm, then window, then surfaceless. On failure
// `out` is empty and `out_error` holds one line.
Status open_display(const DisplayOptions& options, std::unique_ptr<Display>& out,
                    ErrorLine& out_error);

}  // namespace caryatid::platform
