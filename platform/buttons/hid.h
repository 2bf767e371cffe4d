#pragma once
// Buttons on USB: keyboards, button boxes, barcode and RFID readers that type ("wedges"), through
// hidapi's hidraw backend. Only devices of the configured list are opened; anything else that is
// plugged in is ignored, so a visitor's own keyboard does nothing.
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "platform/buttons/buttons.h"
#include "platform/error_line.h"

namespace caryatid::platform {

enum class HidKind : std::uint8_t {
  keyboard,  // Boot report (HID 1.11, appendix B.1): modifiers, reserved byte, six usages.
  wedge,     // A keyboard that types a code and Enter.
  bits,      // A button box: each button is a bit of the report.
};

// What a key of the device means. Which member counts depends on the device's kind.
struct HidKey {
  std::uint16_t button = 0;        // 1..kMaxButtons
  std::uint8_t usage = 0;          // keyboard: HID Usage Tables 1.12, page 0x07 ('a' is 4).
  std::uint8_t byte = 0, bit = 0;  // bits: place in the report, counted behind any report id.
  FixedString<31> code;            // wedge: letters and digits, letters in lower case.
};

struct HidDevice {
  std::uint16_t vendor_id = 0, product_id = 0;  // Both needed.
  std::uint16_t usage_page = 0, usage = 0;      // 0: any; tells interfaces of one device apart.
  std::uint8_t report_id = 0;                   // 0: the device numbers no reports.
  HidKind kind = HidKind::keyboard;
  FixedVector<HidKey, kMaxButtons> keys;
};

inline constexpr std::size_t kMaxHidDevices = 4;

// Turns the reports of one device into events; state without any device, so it can be tested alone.
class HidReader {
 public:
  explicit HidReader(const HidDevice& device) : device_(device) {}
  // One report of any length as read; what is too short or of another id is ignored.
  // quiet: note what is down, but report nothing (a device that was just plugged in).
  void feed(std::span<const std::uint8_t> report, std::int64_t now_us, bool quiet,
            ButtonEvents& out);
  // Releases every pressed button: the device is gone.
  void release_all(std::int64_t now_us, ButtonEvents& out);
  const HidDevice& device() const { return device_; }

 private:
  void feed_keyboard(std::span<const std::uint8_t> body, std::int64_t now_us, bool quiet,
                     ButtonEvents& out);
  void feed_wedge(std::span<const std::uint8_t> body, std::int64_t now_us, bool quiet,
                  ButtonEvents& out);
  void type(std::uint8_t usage, std::int64_t now_us, bool quiet, ButtonEvents& out);
  void set_key(std::size_t index, bool down, std::int64_t now_us, bool quiet, ButtonEvents& out);

  HidDevice device_;
  BitSet<kMaxButtons> down_;      // As the device says, by index of device_.keys.
  BitSet<kMaxButtons> reported_;  // As told to the agent.
  BitSet<256> typed_;             // wedge: usages that are down, so that a held key types once.
  FixedVector<char, 31> code_;    // wedge: typed so far.
  bool too_long_ = false;
  std::int64_t last_typed_us_ = 0;
};

enum class HidFault : std::uint16_t {
  none,
  bad_config,
  no_hidapi,      // hidapi cannot start.
  missing,        // A listed device is not plugged in, or was unplugged.
  no_permission,  // It is there and cannot be opened: the user is not in its group.
};

// Who looks again for a device that is away. That allocates inside hidapi and takes milliseconds,
// or far longer while a device is being plugged in.
enum class HidSearch : std::uint8_t {
  beside_frames,  // A thread of its own: poll() never waits for it.
  in_poll,        // poll() itself: what is found depends on the given times alone.
};

// Opens the service. A device that is not there is no error: it is looked for with growing pauses,
// at most 8 s, and poll() says device_lost (missing or no_permission) as long as one is away.
// A key that is down when its device is plugged in must be released before it counts.
// Allocates; looks for every device once.
Status open_hid_buttons(std::span<const HidDevice> devices, HidSearch search,
                        std::unique_ptr<Buttons>& out, ErrorLine& out_error);

}  // namespace caryatid::platform
