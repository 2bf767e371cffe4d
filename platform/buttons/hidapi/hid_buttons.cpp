#include <hidapi/hidapi.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "platform/buttons/hid.h"
#include "platform/buttons/hidapi/hid_search.h"
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
  // searcher: nullptr: the frame itself searches.
  Device(const HidDevice& device, std::size_t slot, HidSearcher* searcher)
      : reader_(device), slot_(slot), searcher_(searcher) {}
  ~Device() {
    if (handle_ != nullptr) hid_close(handle_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // At start, which may wait.
  void search_now() {
    const HidFound found = search_hid(reader_.device());
    handle_ = found.handle;
    fault_ = found.fault;
  }

  HidFault poll(std::int64_t now_us, ButtonEvents& out) {
    if (!polled_) settle(now_us);
    polled_ = true;
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
  void settle(std::int64_t now_us) {
    settled_at_us_ = now_us + kSettle_us;
    retry_.start(now_us);
  }

  bool look_for(std::int64_t now_us) {
    HidFound found;
    if (asked_) {
      if (!searcher_->take(slot_, &found)) return false;
      asked_ = false;
    } else if (!retry_.due(now_us)) {
      return false;
    } else if (searcher_ != nullptr) {
      searcher_->ask(slot_, reader_.device());
      asked_ = true;
      return false;
    } else {
      found = search_hid(reader_.device());
    }
    handle_ = found.handle;
    fault_ = found.fault;
    if (handle_ != nullptr)
      settle(now_us);
    else
      retry_.failed(now_us);
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
  std::size_t slot_;
  HidSearcher* searcher_;
  hid_device* handle_ = nullptr;
  Retry retry_;
  std::int64_t settled_at_us_ = 0;
  bool polled_ = false, asked_ = false;
  HidFault fault_ = HidFault::missing;
};

class HidButtons final : public Buttons {
 public:
  ~HidButtons() override {
    searcher_.stop();
    devices_.clear();
    hid_exit();
  }

  Status open(std::span<const HidDevice> devices, HidSearch search, ErrorLine& out_error) {
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
    const bool beside = search == HidSearch::beside_frames;
    if (beside && !searcher_.start())
      return refuse(HidFault::no_hidapi,
                    "no thread to look for devices; raise TasksMax of the service", out_error);
    for (const HidDevice& device : devices) {
      devices_.push_back(
          std::make_unique<Device>(device, devices_.size(), beside ? &searcher_ : nullptr));
      devices_.back()->search_now();
    }
    return {};
  }

  Status poll(std::int64_t now_us, ButtonEvents& out) override {
    HidFault worst = HidFault::none;
    for (const auto& device : devices_) worst = std::max(worst, device->poll(now_us, out));
    if (worst == HidFault::none) return {};
    return {Code::device_lost, static_cast<std::uint16_t>(worst)};
  }

 private:
  HidSearcher searcher_;
  std::vector<std::unique_ptr<Device>> devices_;
};

}  // namespace

Status open_hid_buttons(std::span<const HidDevice> devices, HidSearch search,
                        std::unique_ptr<Buttons>& out, ErrorLine& out_error) {
  auto buttons = std::make_unique<HidButtons>();
  CARYATID_TRY(buttons->open(devices, search, out_error));
  out = std::move(buttons);
  return {};
}

}  // namespace caryatid::platform
