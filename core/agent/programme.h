#pragma once
// What the kiosk does when a button is pressed: plain data, filled once from kiosk.toml before
// memory is sealed (firmware-app/config) or baked.
#include <cstdint>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/emotion/emotion.h"

namespace caryatid::agent {

// Buttons of the largest panel that we know of (12), and four for a remote control.
inline constexpr std::size_t kMaxButtons = 16;

struct Button {
  FixedString<31> name;  // As in kiosk.toml and in scripts.
  emotion::Emotion feel = emotion::Emotion::calm;
};

struct Programme {
  FixedVector<Button, kMaxButtons> buttons;

  // Index of the button with this name, or -1. O(buttons).
  int find(std::span<const char> name) const;
};

// A button changed. Times are monotonic; the agent only compares them.
struct ButtonEvent {
  std::uint16_t button = 0;  // Index into Programme::buttons.
  bool pressed = false;
  std::int64_t time_ns = 0;
};

}  // namespace caryatid::agent
