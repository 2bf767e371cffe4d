#pragma once
// The service that tells which buttons visitors press. Backends: gpiod_v1, gpiod_v2, hidapi,
// scripted; the window display delivers its keys in the same form.
#include <cstdint>

#include "core/base/button.h"
#include "core/base/fixed.h"
#include "core/base/status.h"

namespace caryatid::platform {

// Events of one frame. A burst beyond the capacity is bounce or a stuck device: the rest is
// dropped.
using ButtonEvents = FixedVector<ButtonEvent, 32>;

class Buttons {
 public:
  virtual ~Buttons() = default;
  // Appends what happened up to `now_us`, oldest first. Never blocks.
  // device_lost: the device is gone; the backend has appended a release for every pressed button
  // and tries to come back by itself.
  virtual Status poll(std::int64_t now_us, ButtonEvents& out) = 0;
};

}  // namespace caryatid::platform
