#pragma once
#include <atomic>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/golden/image.h"
#include "tests/golden/runtime_folder.h"

struct wl_display;
struct wl_resource;

namespace caryatid::golden {

// The least compositor that a window can live on: one window, one keyboard, pictures in shared
// memory. It does what a test tells it and keeps the last picture. Runs on a thread of its own;
// the calls return when the client can read what they caused.
class ToyCompositor {
 public:
  ToyCompositor();
  ToyCompositor(const ToyCompositor&) = delete;
  ToyCompositor& operator=(const ToyCompositor&) = delete;
  ~ToyCompositor();

  void press(std::uint32_t key);  // And release; codes of linux/input-event-codes.h.
  void resize(std::int32_t width, std::int32_t height);
  void close_window();
  void unplug_keyboard();
  Image picture();  // Of the last commit; empty before the first.

 private:
  friend struct ToyProtocol;  // The protocol's requests.

  void run();
  void tell(std::function<void()> order);
  void configure(std::int32_t width, std::int32_t height);
  void commit();

  RuntimeFolder folder_;
  wl_display* display_ = nullptr;
  wl_resource* surface_ = nullptr;
  wl_resource* buffer_ = nullptr;  // Attached, not yet committed.
  wl_resource* shell_surface_ = nullptr;
  wl_resource* window_ = nullptr;
  wl_resource* seat_ = nullptr;
  wl_resource* keyboard_ = nullptr;
  std::vector<wl_resource*> frames_;  // Callbacks that wait for the next commit.
  bool configured_ = false;
  Image picture_{};

  std::mutex mutex_;  // Held while anything of the above is touched.
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace caryatid::golden
