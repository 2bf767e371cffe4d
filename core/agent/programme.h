#pragma once
// What the kiosk does when a button is pressed: plain data, filled once from kiosk.toml before
// memory is sealed (firmware-app/config) or baked.
#include <cstdint>

#include "core/base/button.h"
#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/emotion/emotion.h"

namespace caryatid::agent {

struct Button {
  FixedString<31> name;  // As in kiosk.toml and in scripts.
  emotion::Emotion feel = emotion::Emotion::calm;
};

struct Programme {
  FixedVector<Button, kMaxButtons> buttons;  // ButtonEvent::button counts these from 1.

  // Index of the button with this name, or -1. O(buttons).
  int find(std::span<const char> name) const;
};

}  // namespace caryatid::agent
