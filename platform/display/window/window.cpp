#include "platform/display/window/window.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <X11/XKBlib.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>
#undef Status  // Xlib says int by it.

#include "platform/display/egl_context.h"

namespace caryatid::platform {
namespace {

// Xlib's own answer to a lost server is exit(); ours is a Status in the next poll().
bool server_lost = false;
int on_io_error(::Display*) {
  server_lost = true;
  return 0;
}
void on_io_error_exit(::Display*, void*) {}  // Returning keeps the process alive.

std::uint16_t button_of(KeySym key) {
  if (key >= XK_1 && key <= XK_9) return static_cast<std::uint16_t>(key - XK_1 + 1);
  if (key >= XK_KP_1 && key <= XK_KP_9) return static_cast<std::uint16_t>(key - XK_KP_1 + 1);
  return 0;
}

class WindowDisplay final : public Display {
 public:
  ~WindowDisplay() override {
    if (x_ == nullptr || server_lost) return;
    if (surface_ != EGL_NO_SURFACE) {
      eglMakeCurrent(egl_.display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroySurface(egl_.display(), surface_);
    }
    if (window_ != 0) XDestroyWindow(x_, window_);
    if (colormap_ != 0) XFreeColormap(x_, colormap_);
    XFlush(x_);  // The connection itself is left to the process: EGL still refers to it.
  }

  Status open(const DisplayOptions& options, ErrorLine& out_error);
  const char* name() const override { return "window (X11)"; }
  std::uint32_t width() const override { return width_; }
  std::uint32_t height() const override { return height_; }
  bool has_surface() const override { return true; }
  GlProc proc_address(const char* gl_name) const override { return eglGetProcAddress(gl_name); }
  Status poll(std::int64_t now_us, DisplayEvents& out) override;
  Status present() override {
    if (server_lost) return lost();
    CARYATID_TRY(egl_.swap(surface_));
    flip_ = {};
    egl_.wait_for_gpu(flip_);
    return {};
  }
  Flip last_flip() const override { return flip_; }

 private:
  static Status lost() {
    return {Code::device_lost, static_cast<std::uint16_t>(DisplayFault::context_lost)};
  }
  Status create_window(const DisplayOptions& options, ErrorLine& out_error);
  void on_key(XEvent& event, std::int64_t now_us, DisplayEvents& out);

  EglContext egl_;
  ::Display* x_ = nullptr;
  Window window_ = 0;
  Colormap colormap_ = 0;
  Atom delete_message_ = 0;
  EGLSurface surface_ = EGL_NO_SURFACE;
  Flip flip_;
  std::uint32_t width_ = 0, height_ = 0;
};

Status WindowDisplay::open(const DisplayOptions& options, ErrorLine& out_error) {
  x_ = XOpenDisplay(nullptr);
  if (x_ == nullptr) {
    set_error(out_error, "no X server answers; set DISPLAY, or use --display surfaceless");
    return {Code::io, static_cast<std::uint16_t>(DisplayFault::no_display_server)};
  }
  server_lost = false;
  XSetIOErrorHandler(on_io_error);
  XSetIOErrorExitHandler(x_, on_io_error_exit, nullptr);
  CARYATID_TRY(egl_.open({.platform = EGL_PLATFORM_X11_EXT,
                          .native_display = x_,
                          .surface_bit = EGL_WINDOW_BIT,
                          .samples = options.samples},
                         out_error));
  CARYATID_TRY(create_window(options, out_error));
  if (options.times_gpu) egl_.time_gpu();
  CARYATID_TRY(egl_.make_current(surface_, out_error));
  eglSwapInterval(egl_.display(), 1);
  return {};
}

Status WindowDisplay::create_window(const DisplayOptions& options, ErrorLine& out_error) {
  XVisualInfo wanted{};
  wanted.visualid = static_cast<VisualID>(egl_.native_visual_id());
  int count = 0;
  XVisualInfo* visual = XGetVisualInfo(x_, VisualIDMask, &wanted, &count);
  if (visual == nullptr) {
    set_error(out_error, "the X server lacks the visual that EGL wants");
    return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::no_config)};
  }
  const Window root = DefaultRootWindow(x_);
  colormap_ = XCreateColormap(x_, root, visual->visual, AllocNone);
  XSetWindowAttributes attributes{};
  attributes.colormap = colormap_;
  attributes.event_mask = KeyPressMask | KeyReleaseMask | StructureNotifyMask;
  width_ = options.width;
  height_ = options.height;
  window_ = XCreateWindow(x_, root, 0, 0, width_, height_, 0, visual->depth, InputOutput,
                          visual->visual, CWColormap | CWEventMask, &attributes);
  XFree(visual);
  XStoreName(x_, window_, options.title);
  delete_message_ = XInternAtom(x_, "WM_DELETE_WINDOW", False);
  XSetWMProtocols(x_, window_, &delete_message_, 1);
  XkbSetDetectableAutoRepeat(x_, True, nullptr);  // A held key is one press.
  XMapWindow(x_, window_);
  surface_ = eglCreateWindowSurface(egl_.display(), egl_.config(), window_, nullptr);
  if (surface_ != EGL_NO_SURFACE) return {};
  set_egl_error(out_error, "EGL cannot draw in an X window");
  return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::no_surface)};
}

void WindowDisplay::on_key(XEvent& event, std::int64_t now_us, DisplayEvents& out) {
  const KeySym key = XLookupKeysym(&event.xkey, 0);
  // The number pad gives digits only in its shifted column.
  const KeySym shifted = XLookupKeysym(&event.xkey, 1);
  const bool pressed = event.type == KeyPress;
  if (pressed && (key == XK_Escape || key == XK_q)) out.close_requested = true;
  const std::uint16_t button = button_of(key) != 0 ? button_of(key) : button_of(shifted);
  if (button == 0) return;
  // A full frame of key events is a stuck keyboard; dropping the rest is the contract.
  if (!out.buttons.push({.button = button, .pressed = pressed, .time_us = now_us})) return;
}

Status WindowDisplay::poll(std::int64_t now_us, DisplayEvents& out) {
  while (!server_lost && XPending(x_) > 0) {
    XEvent event{};
    XNextEvent(x_, &event);
    if (server_lost) break;
    if (event.type == KeyPress || event.type == KeyRelease) on_key(event, now_us, out);
    if (event.type == ClientMessage &&
        static_cast<Atom>(event.xclient.data.l[0]) == delete_message_)
      out.close_requested = true;
    if (event.type == ConfigureNotify) {
      const auto w = static_cast<std::uint32_t>(event.xconfigure.width);
      const auto h = static_cast<std::uint32_t>(event.xconfigure.height);
      out.resized = out.resized || w != width_ || h != height_;
      width_ = w;
      height_ = h;
    }
  }
  return server_lost ? lost() : Status{};
}

}  // namespace

Status open_window(const DisplayOptions& options, std::unique_ptr<Display>& out,
                   ErrorLine& out_error) {
  auto display = std::make_unique<WindowDisplay>();
  CARYATID_TRY(display->open(options, out_error));
  out = std::move(display);
  return {};
}

}  // namespace caryatid::platform
