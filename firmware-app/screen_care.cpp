#include "firmware-app/screen_care.h"

#include <algorithm>

#include "core/base/trig.h"

namespace caryatid::app {
namespace {

constexpr float kFade_s = 3.0f;
// A visitor who presses a button at night gets this long, and more with each press.
constexpr float kAwake_s = 60.0f;
// Two periods without a common one, long enough that nobody sees it move.
constexpr double kAcross_s = 331.0, kUp_s = 217.0;
constexpr double kTurn_rad = 6.283185307179586;

float wave(double time_s, double period_s) {
  const double turns = time_s / period_s;
  const auto whole = static_cast<double>(static_cast<long long>(turns));
  return sin_cos(static_cast<float>((turns - whole) * kTurn_rad)).sin;
}

}  // namespace

void ScreenCare::step(float dt_s, bool busy, bool pressed, bool open) {
  if (!(dt_s > 0.0f)) dt_s = 0.0f;
  awake_s_ = pressed ? kAwake_s : std::max(awake_s_ - dt_s, 0.0f);
  alone_s_ = busy || pressed ? 0.0f : alone_s_ + dt_s;
  const bool tired = config_.off_after_s > 0.0f && alone_s_ >= config_.off_after_s;
  const bool dark = tired || (!open && awake_s_ <= 0.0f);
  const bool dim = config_.dim_after_s > 0.0f && alone_s_ >= config_.dim_after_s;
  const float aim = dark ? 0.0f : dim ? std::clamp(config_.dim_to, 0.0f, 1.0f) : 1.0f;
  light_ = std::max(light_ - dt_s / kFade_s, aim);
  if (!dark && !dim) light_ = 1.0f;
  on_ = !dark || light_ > 0.0f;
  path_s_ += static_cast<double>(dt_s);
  shift_ = 2.0f * config_.wander * Vec2{wave(path_s_, kAcross_s), wave(path_s_, kUp_s)};
}

}  // namespace caryatid::app
