#pragma once
// When to look at the screen's cable, and what a look came to. Pure: no device, no clock.
//
// The kernel's state is polled: its uevents come by netlink, which the service's sandbox shuts out
// together with the network.
#include <cstdint>

namespace caryatid::platform::gbm {

class ScreenWatch {
 public:
  enum class Action : std::uint8_t {
    nothing,
    look,   // A screen is in use: ask still_connected().
    probe,  // None is: find_output(); it may block a little, but nobody sees that.
  };

  // Once a second either a look or a probe.
  Action due(std::int64_t now_us);
  // Answers of the caller. Each says whether this is a change, to be told once.
  bool found() { return change(true); }
  bool missing() { return change(false); }
  // Something else was wrong with the screen: probe it again with the next second.
  void doubt() { in_use_ = false; }

  bool in_use() const { return in_use_; }

 private:
  bool change(bool in_use);

  std::int64_t next_us_ = 0;
  bool in_use_ = false;
  bool told_ = false, told_in_use_ = false;
};

}  // namespace caryatid::platform::gbm
