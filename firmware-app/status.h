#pragma once
// What the kiosk tells of itself to whoever watches over it: one line of JSON (status file and the
// control socket's answer) and the Prometheus text format.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/emotion/emotion.h"
#include "firmware-app/start_times.h"

namespace caryatid::app {

struct KioskStatus {
  double uptime_s = 0.0;
  StartTimes start;
  std::uint64_t starts = 0;    // Of the program on this board, where a state folder remembers them.
  bool unclean_start = false;  // The last run ended without a goodbye: a crash or a power cut.
  std::uint64_t frames = 0, late_frames = 0, presses = 0;
  std::uint64_t rejected_edges = 0;  // Bounce of GPIO and USB buttons.
  bool button_lost = false;          // A device of buttons is away.
  std::uint32_t triangles = 0;
  double cpu_ms = 0.0;  // Of the last frame.
  emotion::Emotion emotion = emotion::Emotion::calm;
  bool has_temperature = false;
  double temperature_celsius = 0.0;
  bool under_voltage = false, throttled = false;
  bool builtin_face = false;    // The pack can't be used and the built-in face stands in.
  bool config_refused = false;  // kiosk.toml can't be used and an older or the built-in one does.
  bool heartbeat_late = false;  // Screen, input or sound stand still.
  std::uint64_t resident_bytes = 0, arena_bytes = 0, allocations_since_seal = 0;
};

// Both write at most out.size() bytes and give the part that was written; nothing when `out` is too
// short (1 KiB always suffices for the JSON, 4 KiB for the other). No allocation.
std::string_view format_json(const KioskStatus& status, std::span<char> out);
std::string_view format_prometheus(const KioskStatus& status, std::span<char> out);

// Resident memory of this process, read from /proc through a descriptor that stays open.
class ResidentMemory {
 public:
  ResidentMemory();
  ~ResidentMemory();
  ResidentMemory(const ResidentMemory&) = delete;
  ResidentMemory& operator=(const ResidentMemory&) = delete;
  std::uint64_t bytes() const;  // 0 where /proc is not there.

 private:
  int descriptor_ = -1;
};

}  // namespace caryatid::app
