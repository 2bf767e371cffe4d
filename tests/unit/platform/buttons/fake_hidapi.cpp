#include "tests/unit/platform/buttons/fake_hidapi.h"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

using caryatid::platform::testing::FakeHid;
using caryatid::platform::testing::hid_world;

// The handle that hidapi keeps opaque.
struct hid_device_ {
  FakeHid* device;
};

extern "C" {

int hid_init(void) { return hid_world.init_result; }
int hid_exit(void) { return 0; }

hid_device_info* hid_enumerate(unsigned short vendor_id, unsigned short product_id) {
  ++hid_world.searches;
  // At most ten seconds: a caller that waits for it fails its test, it does not hang.
  for (int i = 0; hid_world.hangs && i < 10'000; ++i) {
    hid_world.is_hanging = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  hid_world.is_hanging = false;
  hid_device_info* first = nullptr;
  for (FakeHid& device : hid_world.devices) {
    if (!device.plugged || device.vendor_id != vendor_id || device.product_id != product_id)
      continue;
    auto* info = new hid_device_info{};
    info->path = device.path.data();
    info->usage_page = device.usage_page;
    info->usage = device.usage;
    info->next = first;
    first = info;
  }
  return first;
}

void hid_free_enumeration(hid_device_info* first) {
  while (first != nullptr) {
    hid_device_info* const next = first->next;
    delete first;
    first = next;
  }
}

hid_device* hid_open_path(const char* path) {
  for (FakeHid& device : hid_world.devices)
    if (device.path == path && device.plugged && !device.forbidden) {
      ++device.open_count;
      ++hid_world.opens;
      return new hid_device{&device};
    }
  return nullptr;
}

void hid_close(hid_device* device) {
  --device->device->open_count;
  delete device;
}

int hid_read_timeout(hid_device* device, unsigned char* data, size_t length, int) {
  FakeHid& hid = *device->device;
  if (!hid.plugged) return -1;
  if (hid.reports.empty()) return 0;
  const std::vector<std::uint8_t> report = hid.reports.front();
  hid.reports.pop_front();
  const std::size_t size = std::min(length, report.size());
  if (size > 0) std::memcpy(data, report.data(), size);
  return static_cast<int>(size);
}

}  // extern "C"
