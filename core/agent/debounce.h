#pragma once
// Turns the edges of real contacts into presses. The first edge acts at once and locks the button
// for a few milliseconds; what bounces in that time is counted and dropped, and when the lock ends
// the button's true level wins. So a press is never late, and a bounce train is one press.
//
// Kernel or hardware debounce would add its period to every press instead (Linux commit
// 65cff704: the line must have been stable for it), which is why it stays off by default.
#include <array>
#include <cstdint>

#include "core/base/button.h"
#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/status.h"

namespace caryatid::agent {

// Times of one button in microseconds. Mechanical buttons bounce for 0.2 to 20 ms (Ganssle, "A
// Guide to Debouncing", 2004: mean 1.6 ms, worst of 18 switches 157 ms for one bad type).
struct ButtonTiming {
  std::int64_t lockout_us = 10'000;        // 0..1 s. 0: every edge counts.
  std::int64_t long_press_us = 800'000;    // Held this long: `held`. 0: never.
  std::int64_t double_press_us = 400'000;  // From press to press: `pressed_twice`. 0: never.
};

enum class ButtonAction : std::uint8_t {
  pressed,        // At the first edge.
  pressed_twice,  // Right after the `pressed` of the second press of a pair; a third begins anew.
  held,           // Once a press, long_press_us after it.
  released,
};

struct ButtonSignal {
  std::uint16_t button = 0;
  ButtonAction action = ButtonAction::pressed;
  std::int64_t time_us = 0;
};

// The signal as the plain press or release that Agent::step takes; false for the other actions.
constexpr bool as_event(const ButtonSignal& signal, ButtonEvent* out) {
  if (signal.action != ButtonAction::pressed && signal.action != ButtonAction::released)
    return false;
  *out = {signal.button, signal.action == ButtonAction::pressed, signal.time_us};
  return true;
}

// Signals of one frame; what does not fit is counted in DebounceCounts::dropped_signals.
using ButtonSignals = FixedVector<ButtonSignal, 64>;

// Since start. A count that grows while nobody presses tells of a bad switch or cable.
struct DebounceCounts {
  std::uint32_t accepted_edges = 0;
  std::uint32_t rejected_edges = 0;  // Inside the lockout, or without a change of level.
};

// The debouncers of all buttons, which are numbered 1..kMaxButtons.
// Time never runs backwards for a button: an earlier time counts as the latest one seen.
// Cost: O(1) an edge, O(buttons) a frame. No allocation. Not thread-safe.
class Debouncer {
 public:
  // invalid_argument: no such button, or a negative time.
  Status set_timing(std::uint16_t button, const ButtonTiming& timing);
  // One edge as the device gave it; appends what it means.
  // invalid_argument: no such button; the edge is dropped.
  Status feed(const ButtonEvent& edge, ButtonSignals* out);
  // Appends what time alone brings up to `now_us`: ends of lockouts, long presses. Once a frame.
  void advance(std::int64_t now_us, ButtonSignals* out);

  bool is_pressed(std::uint16_t button) const;
  DebounceCounts counts(std::uint16_t button) const;
  std::uint32_t dropped_signals() const { return dropped_signals_; }

 private:
  struct Button {
    ButtonTiming timing;
    DebounceCounts counts;
    std::int64_t latest_us = 0;  // No earlier time is believed.
    std::int64_t locked_until_us = 0;
    std::int64_t pressed_at_us = 0;
    std::int64_t pair_until_us = 0;  // A press before this is the second of a pair. 0: none open.
    bool level = false;              // As the device said last.
    bool pressed = false;            // As reported.
    bool held_sent = false;
  };

  void change(std::uint16_t number, std::int64_t time_us, ButtonSignals* out);
  void catch_up(std::uint16_t number, std::int64_t time_us, ButtonSignals* out);
  void emit(std::uint16_t number, ButtonAction action, std::int64_t time_us, ButtonSignals* out);

  std::array<Button, kMaxButtons> buttons_{};
  std::uint32_t dropped_signals_ = 0;
};

}  // namespace caryatid::agent
