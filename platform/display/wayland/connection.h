#pragma once
// The compositor's side of a Wayland window: what it offers and what it has told us. No EGL here.
#include <wayland-client.h>
#include <xdg-shell-client-protocol.h>

#include "platform/display/display.h"

namespace caryatid::platform {

// Owns every object of the connection. Everything is called on one thread; each object's events
// arrive inside pump(), also in those of EGL's reading that pump() finds queued.
class WaylandConnection {
 public:
  WaylandConnection() = default;
  WaylandConnection(const WaylandConnection&) = delete;
  WaylandConnection& operator=(const WaylandConnection&) = delete;
  ~WaylandConnection();

  // Connects to the compositor that WAYLAND_DISPLAY names and binds what a window needs.
  Status open(ErrorLine& out_error);
  // Makes the window and waits for its first size.
  Status create_window(const DisplayOptions& options, ErrorLine& out_error);

  // Sends what is queued, reads for up to `timeout_ms` (0: only what is there) and lets the events
  // take effect. False: the compositor is gone or has cut us off for good.
  bool pump(int timeout_ms);
  bool lost() const { return wl_display_get_error(display_) != 0; }

  // Asks to be told when the next picture is worth drawing; the next commit (EGL's) sends it.
  void ask_for_frame();
  bool awaits_frame() const { return frame_ != nullptr; }

  wl_display* display() const { return display_; }
  wl_surface* surface() const { return surface_; }
  // The size that the compositor gives, else the wish; pixels.
  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  // Moves what was heard since the last call into `out`, stamped `now_us`; `resized` is not
  // touched.
  void take_events(std::int64_t now_us, DisplayEvents& out);

 private:
  struct Listeners;  // The protocol's callbacks.

  void bind(std::uint32_t name, const char* interface, std::uint32_t version);
  void on_key(std::uint32_t key, bool pressed);

  wl_display* display_ = nullptr;
  wl_registry* registry_ = nullptr;
  wl_compositor* compositor_ = nullptr;
  xdg_wm_base* shell_ = nullptr;
  wl_seat* seat_ = nullptr;
  wl_keyboard* keyboard_ = nullptr;
  wl_surface* surface_ = nullptr;
  xdg_surface* shell_surface_ = nullptr;
  xdg_toplevel* window_ = nullptr;
  wl_callback* frame_ = nullptr;
  std::int32_t width_ = 0, height_ = 0;            // In force.
  std::int32_t next_width_ = 0, next_height_ = 0;  // Told, in force with the next configure.
  bool configured_ = false;
  DisplayEvents heard_;
};

}  // namespace caryatid::platform
