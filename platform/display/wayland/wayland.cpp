#include "platform/display/wayland/wayland.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <wayland-egl.h>

#include "platform/clock/clock.h"
#include "platform/display/egl_context.h"
#include "platform/display/wayland/connection.h"

namespace caryatid::platform {
namespace {

// Longer than the slowest screen's refresh, shorter than any watchdog.
constexpr std::int64_t kFrameWait_us = 100'000;

class WaylandDisplay final : public Display {
 public:
  ~WaylandDisplay() override {
    if (surface_ != EGL_NO_SURFACE) {
      eglMakeCurrent(egl_.display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroySurface(egl_.display(), surface_);
    }
    if (window_ != nullptr) wl_egl_window_destroy(window_);
  }

  Status open(const DisplayOptions& options, ErrorLine& out_error);
  const char* name() const override { return "window (Wayland)"; }
  std::uint32_t width() const override { return static_cast<std::uint32_t>(width_); }
  std::uint32_t height() const override { return static_cast<std::uint32_t>(height_); }
  bool has_surface() const override { return true; }
  GlProc proc_address(const char* gl_name) const override { return eglGetProcAddress(gl_name); }
  Status poll(std::int64_t now_us, DisplayEvents& out) override;
  Status present() override;
  Flip last_flip() const override { return flip_; }

 private:
  static Status lost() {
    return {Code::device_lost, static_cast<std::uint16_t>(DisplayFault::context_lost)};
  }

  WaylandConnection connection_;  // Before EGL, which speaks through it until its own end.
  EglContext egl_;
  wl_egl_window* window_ = nullptr;
  EGLSurface surface_ = EGL_NO_SURFACE;
  Flip flip_;
  std::int32_t width_ = 0, height_ = 0;  // What is drawn; the connection has the newest wish.
};

Status WaylandDisplay::open(const DisplayOptions& options, ErrorLine& out_error) {
  CARYATID_TRY(connection_.open(out_error));
  CARYATID_TRY(egl_.open({.platform = EGL_PLATFORM_WAYLAND_EXT,
                          .native_display = connection_.display(),
                          .surface_bit = EGL_WINDOW_BIT,
                          .samples = options.samples},
                         out_error));
  CARYATID_TRY(connection_.create_window(options, out_error));
  width_ = connection_.width();
  height_ = connection_.height();
  window_ = wl_egl_window_create(connection_.surface(), width_, height_);
  if (window_ != nullptr)
    surface_ = eglCreateWindowSurface(egl_.display(), egl_.config(),
                                      reinterpret_cast<EGLNativeWindowType>(window_), nullptr);
  if (surface_ == EGL_NO_SURFACE) {
    set_egl_error(out_error, "EGL cannot draw in a Wayland window");
    return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::no_surface)};
  }
  if (options.times_gpu) egl_.time_gpu();
  CARYATID_TRY(egl_.make_current(surface_, out_error));
  // EGL's own wait never ends while the window is hidden; present() waits with a limit.
  eglSwapInterval(egl_.display(), 0);
  return {};
}

Status WaylandDisplay::poll(std::int64_t now_us, DisplayEvents& out) {
  if (!connection_.pump(0)) return lost();
  connection_.take_events(now_us, out);
  if (width_ == connection_.width() && height_ == connection_.height()) return {};
  width_ = connection_.width();
  height_ = connection_.height();
  wl_egl_window_resize(window_, width_, height_, 0, 0);
  out.resized = true;
  return {};
}

Status WaylandDisplay::present() {
  const std::int64_t began_us = monotonic_us(), end_us = began_us + kFrameWait_us;
  flip_ = {};
  while (connection_.awaits_frame() && monotonic_us() < end_us)
    if (!connection_.pump(static_cast<int>((end_us - monotonic_us()) / 1000) + 1)) return lost();
  flip_.waited_us = static_cast<std::uint32_t>(monotonic_us() - began_us);
  if (connection_.awaits_frame()) return {};  // Hidden: nobody sees this picture.
  connection_.ask_for_frame();
  const Status swapped = egl_.swap(surface_);
  if (swapped.ok()) egl_.wait_for_gpu(flip_);
  return connection_.lost() ? lost() : swapped;
}

}  // namespace

Status open_wayland(const DisplayOptions& options, std::unique_ptr<Display>& out,
                    ErrorLine& out_error) {
  auto display = std::make_unique<WaylandDisplay>();
  CARYATID_TRY(display->open(options, out_error));
  out = std::move(display);
  return {};
}

}  // namespace caryatid::platform
