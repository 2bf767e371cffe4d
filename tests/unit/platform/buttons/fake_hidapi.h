#pragma once
// USB without a port: hidapi's functions, linked in place of the library, over this small world.
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

struct HidWorld {
  std::list<FakeHid> devices;
  int init_result = 0;
  int searches = 0;
};

inline HidWorld hid_world;

}  // namespace caryatid::platform::testing
