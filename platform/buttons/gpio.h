#pragma once
// Buttons on GPIO lines, through libgpiod 1.6 or 2.x, whichever the build found.
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "platform/buttons/buttons.h"
#include "platform/error_line.h"

namespace caryatid::platform {

enum class GpioBias : std::uint8_t { as_is, disabled, pull_up, pull_down };

// One button's line. By name (best: survives a change of kernel or board), or by chip and offset.
struct GpioLine {
  std::uint16_t button = 0;  // 1..kMaxButtons
  FixedString<63> chip;      // Name, label or path of the chip; empty: look on every chip.
  FixedString<63> line;      // Name of the line; empty: use `offset`, which then needs a chip.
  std::uint32_t offset = 0;
  GpioBias bias = GpioBias::pull_up;
  bool active_low = true;  // The usual wiring: the button pulls the line to ground.
  // Kernel debounce, 0 off. Every press comes later by this much; core debounces without delay.
  // unsupported with libgpiod 1.6.
  std::uint32_t kernel_debounce_us = 0;
};

// Status::detail of this room.
enum class GpioFault : std::uint16_t {
  none,
  no_chip,        // The chip does not exist (yet).
  no_line,        // No line of that name, or the offset is too large.
  busy,           // Another program or driver holds the line; the text names it.
  no_permission,  // The text names the group.
  no_debounce,    // kernel_debounce_us with libgpiod 1.6.
  no_bias,        // The chip cannot do the bias that was asked for.
  gone,           // The device vanished while running.
  not_built,
  bad_config,
  other,
};

// An edge as the kernel saw it. `line` is the index into the configuration.
struct GpioEdge {
  std::uint16_t line = 0;
  bool active = false;
  std::int64_t time_us = 0;  // CLOCK_MONOTONIC at the interrupt.
};

// What differs between the two libgpiod: open, read, level. Nothing here blocks.
class GpioLines {
 public:
  virtual ~GpioLines() = default;
  // Requests every line or none.
  virtual Status open(std::span<const GpioLine> lines, ErrorLine& out_error) = 0;
  virtual void close() = 0;
  // Edges that wait, oldest first for each line; the count is in Result::value, 0 when none wait.
  // not_ready: `out` is full and more wait. device_lost (gone). After lost edges (the kernel's
  // queue overflowed) ends with edges that bring every line to its true level, stamped `now_us`.
  virtual Result<std::size_t> read(std::int64_t now_us, std::span<GpioEdge> out) = 0;
};

// The backend that this build has; `not_built` opens nothing and says so.
std::unique_ptr<GpioLines> make_gpio_lines();

// Opens the lines behind the service. A kiosk must stand without its buttons too: when a line can't
// be had (anything but invalid_argument, with which `out` stays empty), `out` is given all the
// same, says device_lost, and tries again with growing pauses, as it does when a chip is lost
// later. No allocation after open_gpio_buttons but inside libgpiod when a lost chip is opened
// again.
Status open_gpio_buttons(std::span<const GpioLine> lines, std::unique_ptr<Buttons>& out,
                         ErrorLine& out_error);
// The same over given lines, for tests. Takes ownership.
Status open_gpio_buttons(std::span<const GpioLine> lines, std::unique_ptr<GpioLines> device,
                         std::unique_ptr<Buttons>& out, ErrorLine& out_error);

// The error line and Status of a refused chip or line: `what` is the chip or line, `error` errno.
Status gpio_error(GpioFault fault, const char* what, int error, ErrorLine& out_error);

}  // namespace caryatid::platform
