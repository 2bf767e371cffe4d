#pragma once
// USB without a port: hidapi's functions, linked in place of the library, over this small world.
#include <atomic>
#include <cstdint>
#include <deque>
#include <list>
#include <string>
#include <vector>

namespace caryatid::platform::testing {

struct FakeHid {
  std::string path;
  std::uint16_t vendor_id = 0, product_id = 0, usage_page = 1, usage = 6;
  bool forbidden = false;  // Plugged in, but opening fails.
  bool plugged = true;
  int open_count = 0;
  std::deque<std::vector<std::uint8_t>> reports;
};

// A number or flag that two threads look at, in a world that can be begun anew.
template <class T>
struct Shared : std::atomic<T> {
  using std::atomic<T>::atomic;
  Shared& operator=(const Shared& other) {
    this->store(other.load());
    return *this;
  }
  T operator=(T value) { return std::atomic<T>::operator=(value); }
};

struct HidWorld {
  std::list<FakeHid> devices;
  int init_result = 0;
  Shared<int> searches{0}, opens{0};
  Shared<bool> hangs{false}, is_hanging{false};  // hid_enumerate.
};

inline HidWorld hid_world;

}  // namespace caryatid::platform::testing
