#pragma once
#include <cstdint>

namespace caryatid {

// A visitor's button went down or up. Buttons are numbered from 1 as the deployer's configuration
// lists them; time is the monotonic clock of platform/clock (or the script's, under
// --virtual-clock) in microseconds.
struct ButtonEvent {
  std::uint16_t button = 0;
  bool pressed = false;
  std::int64_t time_us = 0;
};

}  // namespace caryatid
