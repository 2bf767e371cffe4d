#pragma once
// Looks for HID devices beside the frame loop: listing and opening goes through udev and may wait
// for a device that is being plugged in, a frame must not.
#include <hidapi/hidapi.h>
#include <pthread.h>

#include <array>
#include <cstdint>

#include "platform/buttons/hid.h"

namespace caryatid::platform {

// What a search came to.
struct HidFound {
  hid_device* handle = nullptr;  // The taker's; nullptr: see `fault`.
  HidFault fault = HidFault::missing;
};

// Lists the devices and opens the first that `wanted` describes. Allocates inside hidapi.
HidFound search_hid(const HidDevice& wanted);

// One thread that searches. Slots are the caller's numbers of his devices.
class HidSearcher {
 public:
  HidSearcher() = default;
  // Waits for a search that is under way; closes what nobody took.
  ~HidSearcher() { stop(); }
  HidSearcher(const HidSearcher&) = delete;
  HidSearcher& operator=(const HidSearcher&) = delete;

  // False: the system refuses a thread.
  bool start();
  void stop();

  // Asks for a search; `wanted` must stay as it is until take() gives its answer. Never waits
  // longer than it takes to copy a pointer, as the next.
  void ask(std::size_t slot, const HidDevice& wanted);
  // True once for each ask(): the answer is in `out`.
  bool take(std::size_t slot, HidFound* out);

 private:
  enum class State : std::uint8_t { idle, asked, searching, answered };
  struct Slot {
    State state = State::idle;
    const HidDevice* wanted = nullptr;
    HidFound found;
  };
  static void* thread_main(void* self);
  void run();

  std::array<Slot, kMaxHidDevices> slots_{};
  pthread_t thread_{};
  pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
  pthread_cond_t change_ = PTHREAD_COND_INITIALIZER;
  bool running_ = false, ending_ = false;
};

}  // namespace caryatid::platform
