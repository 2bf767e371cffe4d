#include <hidapi/hidapi.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "platform/buttons/hid.h"
#include "platform/retry.h"

namespace caryatid::platform {
namespace {

// Longest report of a full-speed device, and how many one frame takes from a device that chatters.
constexpr std::size_t kReport_bytes = 64;
constexpr int kReportsPerPoll = 16;
// What a device says in this time after it was plugged in is its state, not a press.
constexpr std::int64_t kSettle_us = 300'000;

Status refuse(HidFault fault, const char* text, ErrorLine& out_error) {
  char line[256];
  const int length = std::snprintf(line, sizeof line, "buttons: %s", text);
  out_error.assign({line, static_cast<std::size_t>(std::max(length, 0))});
  return {fault == HidFault::bad_config ? Code::invalid_argument : Code::io,
          static_cast<std::uint16_t>(fault)};
}

// One listed device, there or not.
class Device {
 public:
  explicit Device(const HidDevice& device) : reader_(device) {}
  ~Device() {
    if (handle_ != nullptr) hid_close(handle_);
  }
  Device(Device&& other) noexcept
      : reader_(other.reader_), handle_(std::exchange(other.handle_, nullptr)) {}
  Device& operator=(Device&&) = delete;

  HidFault poll(std::int64_t now_us, ButtonEvents& out) {
    if (handle_ == nullptr && !look_for(now_us)) return fault_;
    std::uint8_t report[kReport_bytes];
    for (int i = 0; i < kReportsPerPoll; ++i) {
      // With a timeout of 0: a non-blocking hid_read() does not see an unplug on every kernel.
      const int size = hid_read_timeout(handle_, report, sizeof report, 0);
      if (size == 0) return HidFault::none;
      if (size < 0) return lose(now_us, out);
      const auto bytes = std::span<const std::uint8_t>(report, static_cast<std::size_t>(size));
      reader_.feed(bytes, now_us, now_us < settled_at_us_, out);
    }
    return HidFault::none;
  }

 private:
  bool look_for(std::int64_t now_us) {
    if (searched_ && !retry_.due(now_us)) return false;
    fault_ = HidFault::missing;
    const HidDevice& wanted = reader_.device();
    hid_device_info* const found = hid_enumerate(wanted.vendor_id, wanted.product_id);
    for (const hid_device_info* info = found; info != nullptr; info = info->next) {
      if (wanted.usage_page != 0 && info->usage_page != wanted.usage_page) continue;
      if (wanted.usage != 0 && info->usage != wanted.usage) continue;
      handle_ = hid_open_path(info->path);
      if (handle_ != nullptr) break;
      fault_ = HidFault::no_permission;
    }
    hid_free_enumeration(found);
    if (handle_ != nullptr) {
      settled_at_us_ = now_us + kSettle_us;
    } else if (searched_) {
      retry_.failed(now_us);
    } else {
      retry_.start(now_us);
    }
    searched_ = true;
    return handle_ != nullptr;
  }

  HidFault lose(std::int64_t now_us, ButtonEvents& out) {
    hid_close(handle_);
    handle_ = nullptr;
    reader_.release_all(now_us, out);
    retry_.start(now_us);
    fault_ = HidFault::missing;
    return fault_;
  }

  HidReader reader_;
  hid_device* handle_ = nullptr;
  Retry retry_;
  std::int64_t settled_at_us_ = 0;
  bool searched_ = false;
  HidFault fault_ = HidFault::missing;
};

class HidButtons final : public Buttons {
 public:
  HidButtons() { devices_.reserve(kMaxHidDevices); }
  ~HidButtons() override {
    devices_.clear();
    hid_exit();
  }

  Status open(std::span<const HidDevice> devices, ErrorLine& out_error) {
    if (devices.size() > kMaxHidDevices)
      return refuse(HidFault::bad_config, "at most 4 HID devices", out_error);
    for (const HidDevice& device : devices) {
      if (device.vendor_id == 0 || device.product_id == 0)
        return refuse(HidFault::bad_config, "a HID device needs vendor and product ids", out_error);
      for (const HidKey& key : device.keys)
        if (key.button < 1 || key.button > kMaxButtons)
          return refuse(HidFault::bad_config, "a HID key needs a button from 1 to 16", out_error);
    }
    if (hid_init() != 0) return refuse(HidFault::no_hidapi, "hidapi does not start", out_error);
    for (const HidDevice& device : devices) devices_.emplace_back(device);
    return {};
  }

  Status poll(std::int64_t now_us, ButtonEvents& out) override {
    HidFault worst = HidFault::none;
    for (Device& device : devices_) worst = std::max(worst, device.poll(now_us, out));
    if (worst == HidFault::none) return {};
    return {Code::device_lost, static_cast<std::uint16_t>(worst)};
  }

 private:
  std::vector<Device> devices_;
};

}  // namespace

Status open_hid_buttons(std::span<const HidDevice> devices, std::unique_ptr<Buttons>& out,
                        ErrorLine& out_error) {
  auto buttons = std::make_unique<HidButtons>();
  CARYATID_TRY(buttons->open(devices, out_error));
  out = std::move(buttons);
  return {};
}

}  // namespace caryatid::platform
