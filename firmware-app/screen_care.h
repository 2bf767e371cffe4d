#pragma once
// Care for a screen that shows one person for years: left alone it dims and later goes dark, and
// the picture wanders by a few pixels, so that no edge burns in. Pure: no device, no clock.
#include "core/base/vec.h"

namespace caryatid::app {

// [screen] of kiosk.toml. The defaults never switch anything off by themselves.
struct ScreenCareConfig {
  float dim_after_s = 0.0f;  // Alone for so long; 0: never.
  float off_after_s = 0.0f;  // 0: never.
  float dim_to = 0.4f;       // Share of the light, 0..1.
  float wander = 0.01f;      // Of the picture's height, each way; 0: still.
};

class ScreenCare {
 public:
  ScreenCare() = default;
  explicit ScreenCare(const ScreenCareConfig& config) : config_(config) {}

  // Once a frame. busy: somebody is there or something is said. pressed: a button went down, which
  // wakes even a screen that is off outside opening hours. open: the schedule wants the screen on.
  void step(float dt_s, bool busy, bool pressed, bool open = true);

  // False once the light has gone out; a window, which can't be switched off, is black then.
  bool screen_on() const { return on_; }
  // Share of the full light; comes at once and goes within seconds.
  float light() const { return light_; }
  // Shift of the picture in its halves (clip space): a slow path that comes by everywhere.
  Vec2 shift() const { return shift_; }

 private:
  ScreenCareConfig config_;
  float alone_s_ = 0.0f;
  float awake_s_ = 0.0f;  // Left of what a press out of hours buys.
  float light_ = 1.0f;
  bool on_ = true;
  double path_s_ = 0.0;
  Vec2 shift_{0};
};

}  // namespace caryatid::app
