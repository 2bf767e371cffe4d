#include "tests/golden/toy_compositor.h"

#include <fcntl.h>
#include <unistd.h>
#include <wayland-server.h>
#include <xdg-shell-server-protocol.h>

#include <chrono>
#include <utility>

namespace caryatid::golden {

// Requests of no interest are `ignore`; those that the backend has no reason to make stay null.
struct ToyProtocol {
  static ToyCompositor& toy(wl_resource* resource) {
    return *static_cast<ToyCompositor*>(wl_resource_get_user_data(resource));
  }
  template <typename... Arguments>
  static void ignore(wl_client*, wl_resource*, Arguments...) {}
  static void destroy(wl_client*, wl_resource* resource) { wl_resource_destroy(resource); }

  // A new object of `parent`'s version.
  static wl_resource* make(wl_client* client, const wl_interface& interface, wl_resource* parent,
                           std::uint32_t id, const void* implementation) {
    wl_resource* made = wl_resource_create(client, &interface, wl_resource_get_version(parent), id);
    wl_resource_set_implementation(made, implementation, wl_resource_get_user_data(parent),
                                   nullptr);
    return made;
  }
  // The root object of one client.
  static wl_resource* bind(wl_client* client, const wl_interface& interface, std::uint32_t version,
                           std::uint32_t id, const void* implementation, void* toy) {
    wl_resource* made = wl_resource_create(client, &interface, static_cast<int>(version), id);
    wl_resource_set_implementation(made, implementation, toy, nullptr);
    return made;
  }
  static void offer_all(ToyCompositor* toy);

  static const struct wl_surface_interface& surface() {
    static struct wl_surface_interface s {};
    s.destroy = destroy;
    s.damage = ignore;
    s.damage_buffer = ignore;
    s.set_opaque_region = ignore;
    s.attach = [](wl_client*, wl_resource* r, wl_resource* buffer, std::int32_t, std::int32_t) {
      toy(r).buffer_ = buffer;
    };
    s.frame = [](wl_client* client, wl_resource* r, std::uint32_t id) {
      toy(r).frames_.push_back(make(client, wl_callback_interface, r, id, nullptr));
    };
    s.commit = [](wl_client*, wl_resource* r) { toy(r).commit(); };
    return s;
  }

  static const struct wl_compositor_interface& compositor() {
    static struct wl_compositor_interface c {};
    c.create_surface = [](wl_client* client, wl_resource* r, std::uint32_t id) {
      toy(r).surface_ = make(client, wl_surface_interface, r, id, &surface());
    };
    return c;
  }

  static const struct xdg_toplevel_interface& window() {
    static struct xdg_toplevel_interface w {};
    w.destroy = destroy;
    w.set_title = ignore;
    w.set_app_id = ignore;
    return w;
  }

  static const struct xdg_surface_interface& shell_surface() {
    static struct xdg_surface_interface s {};
    s.destroy = destroy;
    s.ack_configure = ignore;
    s.get_toplevel = [](wl_client* client, wl_resource* r, std::uint32_t id) {
      toy(r).window_ = make(client, xdg_toplevel_interface, r, id, &window());
    };
    return s;
  }

  static const struct xdg_wm_base_interface& shell() {
    static struct xdg_wm_base_interface s {};
    s.destroy = destroy;
    s.get_xdg_surface = [](wl_client* client, wl_resource* r, std::uint32_t id, wl_resource*) {
      toy(r).shell_surface_ = make(client, xdg_surface_interface, r, id, &shell_surface());
    };
    return s;
  }

  static const struct wl_seat_interface& seat() {
    static struct wl_seat_interface s {};
    static struct wl_keyboard_interface k {};
    s.get_keyboard = [](wl_client* client, wl_resource* r, std::uint32_t id) {
      wl_resource* keyboard = make(client, wl_keyboard_interface, r, id, &k);
      const int none = open("/dev/null", O_RDONLY | O_CLOEXEC);
      wl_keyboard_send_keymap(keyboard, WL_KEYBOARD_KEYMAP_FORMAT_NO_KEYMAP, none, 0);
      close(none);
      toy(r).keyboard_ = keyboard;
    };
    return s;
  }
};

void ToyProtocol::offer_all(ToyCompositor* toy) {
  wl_display* display = toy->display_;
  wl_display_init_shm(display);
  wl_global_create(display, &wl_compositor_interface, 4, toy,
                   [](wl_client* client, void* data, std::uint32_t version, std::uint32_t id) {
                     bind(client, wl_compositor_interface, version, id, &compositor(), data);
                   });
  wl_global_create(display, &xdg_wm_base_interface, 1, toy,
                   [](wl_client* client, void* data, std::uint32_t version, std::uint32_t id) {
                     bind(client, xdg_wm_base_interface, version, id, &shell(), data);
                   });
  wl_global_create(display, &wl_seat_interface, 4, toy,
                   [](wl_client* client, void* data, std::uint32_t version, std::uint32_t id) {
                     wl_resource* r = bind(client, wl_seat_interface, version, id, &seat(), data);
                     static_cast<ToyCompositor*>(data)->seat_ = r;
                     wl_seat_send_capabilities(r, WL_SEAT_CAPABILITY_KEYBOARD);
                   });
}

ToyCompositor::ToyCompositor() : display_(wl_display_create()) {
  if (wl_display_add_socket(display_, "toy") != 0) return;
  ToyProtocol::offer_all(this);
  thread_ = std::thread([this] { run(); });
}

ToyCompositor::~ToyCompositor() {
  ends_ = true;
  if (thread_.joinable()) thread_.join();
  wl_display_destroy_clients(display_);
  wl_display_destroy(display_);
}

void ToyCompositor::run() {
  using namespace std::chrono_literals;
  while (!ends_) {
    {
      const std::lock_guard lock(mutex_);
      wl_event_loop_dispatch(wl_display_get_event_loop(display_), 0);
      wl_display_flush_clients(display_);
    }
    std::this_thread::sleep_for(1ms);
  }
}

void ToyCompositor::tell(std::function<void()> order) {
  const std::lock_guard lock(mutex_);
  order();
  wl_display_flush_clients(display_);
}

void ToyCompositor::configure(std::int32_t width, std::int32_t height) {
  wl_array states;
  wl_array_init(&states);
  xdg_toplevel_send_configure(window_, width, height, &states);
  xdg_surface_send_configure(shell_surface_, wl_display_next_serial(display_));
  configured_ = true;
}

void ToyCompositor::commit() {
  if (!configured_) configure(0, 0);  // "Choose yourself."
  if (buffer_ != nullptr) {
    wl_shm_buffer* shared = wl_shm_buffer_get(buffer_);
    picture_ = {static_cast<std::uint32_t>(wl_shm_buffer_get_width(shared)),
                static_cast<std::uint32_t>(wl_shm_buffer_get_height(shared)),
                {}};
    wl_shm_buffer_begin_access(shared);
    const auto* bytes = static_cast<const std::uint8_t*>(wl_shm_buffer_get_data(shared));
    const auto stride = static_cast<std::size_t>(wl_shm_buffer_get_stride(shared));
    for (std::size_t y = 0; y < picture_.height; ++y)
      for (std::size_t x = 0; x < picture_.width; ++x)
        for (const std::size_t channel : {2u, 1u, 0u})  // XRGB8888, lowest byte first.
          picture_.rgb.push_back(bytes[y * stride + x * 4 + channel]);
    wl_shm_buffer_end_access(shared);
    wl_buffer_send_release(buffer_);
    buffer_ = nullptr;
  }
  for (wl_resource* frame : std::exchange(frames_, {})) {
    wl_callback_send_done(frame, 0);
    wl_resource_destroy(frame);
  }
}

void ToyCompositor::press(std::uint32_t key) {
  tell([&] {
    for (const auto state : {WL_KEYBOARD_KEY_STATE_PRESSED, WL_KEYBOARD_KEY_STATE_RELEASED})
      wl_keyboard_send_key(keyboard_, wl_display_next_serial(display_), 0, key, state);
  });
}

void ToyCompositor::resize(std::int32_t width, std::int32_t height) {
  tell([&] { configure(width, height); });
}

void ToyCompositor::close_window() {
  tell([&] { xdg_toplevel_send_close(window_); });
}

void ToyCompositor::unplug_keyboard() {
  tell([&] { wl_seat_send_capabilities(seat_, 0); });
}

Image ToyCompositor::picture() {
  const std::lock_guard lock(mutex_);
  return picture_;
}

}  // namespace caryatid::golden
