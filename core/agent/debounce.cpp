#include "core/agent/debounce.h"

#include <algorithm>

namespace caryatid::agent {
namespace {

bool exists(std::uint16_t number) { return number >= 1 && number <= kMaxButtons; }

}  // namespace

Status Debouncer::set_timing(std::uint16_t button, const ButtonTiming& timing) {
  if (!exists(button) || timing.lockout_us < 0 || timing.long_press_us < 0 ||
      timing.double_press_us < 0)
    return {Code::invalid_argument};
  buttons_[button - 1u].timing = timing;
  return {};
}

Status Debouncer::feed(const ButtonEvent& edge, ButtonSignals* out) {
  if (!exists(edge.button)) return {Code::invalid_argument};
  Button& button = buttons_[edge.button - 1u];
  const std::int64_t time_us = std::max(edge.time_us, button.latest_us);
  catch_up(edge.button, time_us, out);
  button.level = edge.pressed;
  if (edge.pressed == button.pressed || time_us < button.locked_until_us) {
    ++button.counts.rejected_edges;
    return {};
  }
  ++button.counts.accepted_edges;
  change(edge.button, time_us, out);
  return {};
}

void Debouncer::advance(std::int64_t now_us, ButtonSignals* out) {
  for (std::uint16_t number = 1; number <= kMaxButtons; ++number) catch_up(number, now_us, out);
}

bool Debouncer::is_pressed(std::uint16_t button) const {
  return exists(button) && buttons_[button - 1u].pressed;
}

DebounceCounts Debouncer::counts(std::uint16_t button) const {
  return exists(button) ? buttons_[button - 1u].counts : DebounceCounts{};
}

// Reports the other state and locks the button.
void Debouncer::change(std::uint16_t number, std::int64_t time_us, ButtonSignals* out) {
  Button& button = buttons_[number - 1u];
  button.pressed = !button.pressed;
  button.locked_until_us = time_us + button.timing.lockout_us;
  if (!button.pressed) {
    emit(number, ButtonAction::released, time_us, out);
    return;
  }
  emit(number, ButtonAction::pressed, time_us, out);
  const bool second = time_us < button.pair_until_us;
  if (second) emit(number, ButtonAction::pressed_twice, time_us, out);
  button.pair_until_us = second ? 0 : time_us + button.timing.double_press_us;
  button.pressed_at_us = time_us;
  button.held_sent = false;
}

// What time brings up to `time_us`, in its order: a long press may fall before the end of a lock.
void Debouncer::catch_up(std::uint16_t number, std::int64_t time_us, ButtonSignals* out) {
  Button& button = buttons_[number - 1u];
  button.latest_us = std::max(button.latest_us, time_us);
  const auto send_held_before = [&](std::int64_t limit_us) {
    const std::int64_t due_us = button.pressed_at_us + button.timing.long_press_us;
    if (!button.pressed || button.held_sent || button.timing.long_press_us == 0) return;
    if (due_us > limit_us) return;
    emit(number, ButtonAction::held, due_us, out);
    button.held_sent = true;
  };
  if (button.level != button.pressed && button.locked_until_us <= time_us) {
    send_held_before(button.locked_until_us);
    change(number, button.locked_until_us, out);
  }
  send_held_before(time_us);
}

void Debouncer::emit(std::uint16_t number, ButtonAction action, std::int64_t time_us,
                     ButtonSignals* out) {
  if (!out->push({number, action, time_us})) ++dropped_signals_;
}

}  // namespace caryatid::agent
