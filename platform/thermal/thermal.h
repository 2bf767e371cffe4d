#pragma once
// How warm the board is, and whether its supply sags: read once a second from sysfs, so that the
// frame budget can give way before the firmware throttles.
#include <array>
#include <cstdint>
#include <optional>

#include "core/base/fixed.h"
#include "core/base/status.h"

namespace caryatid::platform {

enum class Heat : std::uint8_t { normal, warm, hot, critical };  // As lod::ThermalLevel.

// Where the steps lie, in thousandths of a degree Celsius. The Raspberry Pi's firmware caps its
// clock from 80 degrees and further at 85 (raspberrypi.com, "Frequency management and thermal
// control"): hot begins before the first, critical before the second.
struct HeatSteps {
  std::int32_t warm_mC = 65'000, hot_mC = 76'000, critical_mC = 83'000;
  std::int32_t hysteresis_mC = 4'000;  // A step is left this far below where it began.
};

// The step for a reading; pure. `before` is the step until now.
Heat heat_step(std::int32_t temperature_mC, Heat before, const HeatSteps& steps = {});

// Bits of the Raspberry Pi's get_throttled: now; the same 16 bits up: since boot.
struct Supply {
  bool under_voltage = false, clock_capped = false, throttled = false, soft_limit = false;
  bool under_voltage_since_boot = false;
};
Supply supply_of(std::uint32_t get_throttled);
// What the frame budget makes of it: a slowed clock is heat, whatever the sensor says, and a supply
// that sags must be spared before the firmware slows the clock.
Heat heat_of(const Supply& supply);

struct ThermalReading {
  std::int32_t temperature_mC = 0;  // Of the hottest zone.
  Heat heat = Heat::normal;         // By temperature, and by what the supply does now.
  std::optional<Supply> supply;     // Nothing where the board does not tell.
};

// No allocation after open(); reading costs a few system calls.
class Thermal {
 public:
  Thermal() = default;
  ~Thermal();
  Thermal(const Thermal&) = delete;
  Thermal& operator=(const Thermal&) = delete;

  // Opens every thermal zone under `sysfs` (tests give their own folder). Without any, read() is
  // unsupported and the board counts as normal.
  Status open(const char* sysfs = "/sys", const HeatSteps& steps = {});
  // unsupported: no zone. io: none could be read now; the last reading stays.
  Status read(ThermalReading* out);

 private:
  static constexpr std::size_t kMaxZones = 16;  // The largest boards have about ten.
  FixedVector<int, kMaxZones> zones_;
  int throttled_ = -1;
  HeatSteps steps_;
  Heat heat_ = Heat::normal;
};

}  // namespace caryatid::platform
