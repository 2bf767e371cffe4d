#include "platform/display/wayland/connection.h"

#include <linux/input-event-codes.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <cstring>

#include "platform/display/egl_context.h"

namespace caryatid::platform {
namespace {

constexpr std::uint32_t kSeatVersion = 5, kCompositorVersion = 4;
constexpr std::uint32_t kNumberPad[] = {KEY_KP1, KEY_KP2, KEY_KP3, KEY_KP4, KEY_KP5,
                                        KEY_KP6, KEY_KP7, KEY_KP8, KEY_KP9};

std::uint16_t button_of(std::uint32_t key) {
  if (key >= KEY_1 && key <= KEY_9) return static_cast<std::uint16_t>(key - KEY_1 + 1);
  const auto at = std::find(std::begin(kNumberPad), std::end(kNumberPad), key);
  if (at == std::end(kNumberPad)) return 0;
  return static_cast<std::uint16_t>(at - std::begin(kNumberPad) + 1);
}

template <typename T>
T* bind_as(wl_registry* registry, std::uint32_t name, const wl_interface& interface,
           std::uint32_t version) {
  return static_cast<T*>(wl_registry_bind(registry, name, &interface, version));
}

Status no_server(const char* text, ErrorLine& out_error) {
  set_error(out_error, text);
  return {Code::io, static_cast<std::uint16_t>(DisplayFault::no_display_server)};
}

}  // namespace

// libwayland wants every callback of an interface set, so those of no interest stand here empty.
struct WaylandConnection::Listeners {
  static WaylandConnection& self(void* data) { return *static_cast<WaylandConnection*>(data); }

  static constexpr wl_registry_listener registry = {
      .global = [](void* data, wl_registry*, std::uint32_t name, const char* interface,
                   std::uint32_t version) { self(data).bind(name, interface, version); },
      .global_remove = [](void*, wl_registry*, std::uint32_t) {}};

  static constexpr xdg_wm_base_listener shell = {
      .ping = [](void*, xdg_wm_base* shell, std::uint32_t serial) {
        xdg_wm_base_pong(shell, serial);
      }};

  static constexpr wl_keyboard_listener keyboard = {
      .keymap = [](void*, wl_keyboard*, std::uint32_t, int fd, std::uint32_t) { close(fd); },
      .enter = [](void*, wl_keyboard*, std::uint32_t, wl_surface*, wl_array*) {},
      .leave = [](void*, wl_keyboard*, std::uint32_t, wl_surface*) {},
      .key =
          [](void* data, wl_keyboard*, std::uint32_t, std::uint32_t, std::uint32_t key,
             std::uint32_t state) {
            self(data).on_key(key, state == WL_KEYBOARD_KEY_STATE_PRESSED);
          },
      .modifiers = [](void*, wl_keyboard*, std::uint32_t, std::uint32_t, std::uint32_t,
                      std::uint32_t, std::uint32_t) {},
      .repeat_info = [](void*, wl_keyboard*, std::int32_t, std::int32_t) {}};

  static constexpr wl_seat_listener seat = {
      .capabilities =
          [](void* data, wl_seat* seat, std::uint32_t capabilities) {
            wl_keyboard*& keyboard = self(data).keyboard_;
            const bool has = (capabilities & WL_SEAT_CAPABILITY_KEYBOARD) != 0;
            if (has && keyboard == nullptr) {
              keyboard = wl_seat_get_keyboard(seat);
              wl_keyboard_add_listener(keyboard, &Listeners::keyboard, data);
            } else if (!has && keyboard != nullptr) {
              wl_keyboard_destroy(keyboard);
              keyboard = nullptr;
            }
          },
      .name = [](void*, wl_seat*, const char*) {}};

  static constexpr xdg_surface_listener shell_surface = {
      .configure = [](void* data, xdg_surface* surface, std::uint32_t serial) {
        WaylandConnection& c = self(data);
        xdg_surface_ack_configure(surface, serial);
        c.configured_ = true;
        if (c.next_width_ > 0) c.width_ = c.next_width_;  // 0: our choice, which is what it was.
        if (c.next_height_ > 0) c.height_ = c.next_height_;
      }};

  static constexpr xdg_toplevel_listener window = {
      .configure =
          [](void* data, xdg_toplevel*, std::int32_t width, std::int32_t height, wl_array*) {
            self(data).next_width_ = width;
            self(data).next_height_ = height;
          },
      .close = [](void* data, xdg_toplevel*) { self(data).heard_.close_requested = true; },
      .configure_bounds = [](void*, xdg_toplevel*, std::int32_t, std::int32_t) {},
      .wm_capabilities = [](void*, xdg_toplevel*, wl_array*) {}};

  static constexpr wl_callback_listener frame = {
      .done = [](void* data, wl_callback* callback, std::uint32_t) {
        wl_callback_destroy(callback);
        self(data).frame_ = nullptr;
      }};
};

WaylandConnection::~WaylandConnection() {
  if (display_ == nullptr) return;
  if (frame_ != nullptr) wl_callback_destroy(frame_);
  if (window_ != nullptr) xdg_toplevel_destroy(window_);
  if (shell_surface_ != nullptr) xdg_surface_destroy(shell_surface_);
  if (surface_ != nullptr) wl_surface_destroy(surface_);
  if (keyboard_ != nullptr) wl_keyboard_destroy(keyboard_);
  if (seat_ != nullptr) wl_seat_destroy(seat_);
  if (shell_ != nullptr) xdg_wm_base_destroy(shell_);
  if (compositor_ != nullptr) wl_compositor_destroy(compositor_);
  if (registry_ != nullptr) wl_registry_destroy(registry_);
  wl_display_flush(display_);
  wl_display_disconnect(display_);
}

Status WaylandConnection::open(ErrorLine& out_error) {
  wl_log_set_handler_client([](const char*, va_list) {});  // Ours is the line that tells.
  display_ = wl_display_connect(nullptr);
  if (display_ == nullptr)
    return no_server("no Wayland compositor answers; set WAYLAND_DISPLAY and XDG_RUNTIME_DIR",
                     out_error);
  registry_ = wl_display_get_registry(display_);
  wl_registry_add_listener(registry_, &Listeners::registry, this);
  if (wl_display_roundtrip(display_) < 0)
    return no_server("the Wayland compositor hangs up at once", out_error);
  if (compositor_ != nullptr && shell_ != nullptr) return {};
  set_error(out_error, "the Wayland compositor offers no desktop windows (xdg_wm_base)");
  return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::no_surface)};
}

void WaylandConnection::bind(std::uint32_t name, const char* interface, std::uint32_t version) {
  const auto is = [&](const wl_interface& i) { return std::strcmp(interface, i.name) == 0; };
  if (is(wl_compositor_interface) && compositor_ == nullptr) {
    compositor_ = bind_as<wl_compositor>(registry_, name, wl_compositor_interface,
                                         std::min(version, kCompositorVersion));
  } else if (is(xdg_wm_base_interface) && shell_ == nullptr) {
    shell_ = bind_as<xdg_wm_base>(registry_, name, xdg_wm_base_interface, 1);
    xdg_wm_base_add_listener(shell_, &Listeners::shell, this);
  } else if (is(wl_seat_interface) && seat_ == nullptr) {
    seat_ = bind_as<wl_seat>(registry_, name, wl_seat_interface, std::min(version, kSeatVersion));
    wl_seat_add_listener(seat_, &Listeners::seat, this);
  }
}

Status WaylandConnection::create_window(const DisplayOptions& options, ErrorLine& out_error) {
  width_ = static_cast<std::int32_t>(options.width);
  height_ = static_cast<std::int32_t>(options.height);
  surface_ = wl_compositor_create_surface(compositor_);
  shell_surface_ = xdg_wm_base_get_xdg_surface(shell_, surface_);
  xdg_surface_add_listener(shell_surface_, &Listeners::shell_surface, this);
  window_ = xdg_surface_get_toplevel(shell_surface_);
  xdg_toplevel_add_listener(window_, &Listeners::window, this);
  xdg_toplevel_set_title(window_, options.title);
  xdg_toplevel_set_app_id(window_, "caryatid");
  wl_surface_commit(surface_);  // Without a picture: asks for a size.
  while (!configured_)
    if (wl_display_dispatch(display_) < 0)
      return no_server("the Wayland compositor hung up before it gave the window a size",
                       out_error);
  return {};
}

bool WaylandConnection::pump(int timeout_ms) {
  while (wl_display_prepare_read(display_) != 0)
    if (wl_display_dispatch_pending(display_) < 0) return false;
  wl_display_flush(display_);  // A hang-up shows in the reading.
  pollfd ready{.fd = wl_display_get_fd(display_), .events = POLLIN, .revents = 0};
  if (::poll(&ready, 1, timeout_ms) > 0) {
    if (wl_display_read_events(display_) < 0) return false;
  } else {
    wl_display_cancel_read(display_);
  }
  return wl_display_dispatch_pending(display_) >= 0;
}

void WaylandConnection::ask_for_frame() {
  frame_ = wl_surface_frame(surface_);
  wl_callback_add_listener(frame_, &Listeners::frame, this);
}

void WaylandConnection::on_key(std::uint32_t key, bool pressed) {
  if (pressed && (key == KEY_ESC || key == KEY_Q)) heard_.close_requested = true;
  const std::uint16_t button = button_of(key);
  if (button == 0) return;
  // A full frame of key events is a stuck keyboard; dropping the rest is the contract.
  if (!heard_.buttons.push({.button = button, .pressed = pressed, .time_us = 0})) return;
}

void WaylandConnection::take_events(std::int64_t now_us, DisplayEvents& out) {
  for (ButtonEvent event : heard_.buttons) {
    event.time_us = now_us;
    if (!out.buttons.push(event)) break;
  }
  out.close_requested = out.close_requested || heard_.close_requested;
  heard_ = {};
}

}  // namespace caryatid::platform
