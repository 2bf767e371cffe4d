#include "core/agent/agent.h"

#include <algorithm>

namespace caryatid::agent {
namespace {

// A smile for the visitor takes so long to come or go (time constant; emotions.md 3.4's offsets).
constexpr float kFriendlyTime_s = 0.5f;

// What is left of the whole when every feeling has taken its part.
float unfelt(const emotion::Weights& w) {
  float sum = 0.0f;
  for (const float each : w) sum += each;
  return std::max(0.0f, 1.0f - sum);
}

}  // namespace

void Agent::press() {
  pressed_ = true;
  since_press_s_ = 0.0f;
}

void Agent::feel(emotion::Emotion e) { feeling_.feel(e); }

void Agent::feel(emotion::Emotion e, float strength) {
  feeling_.hold(e, strength);
  since_press_s_ = 0.0f;
}

emotion::Weights Agent::mood() const {
  emotion::Weights out{};
  const emotion::Emotion e = feeling_.current();
  if (e != emotion::Emotion::calm) out[emotion::index_of(e)] = feeling_.strength();
  return out;
}

const Intentions& Agent::step(float dt_s) {
  const float dt = dt_s > 0.0f ? std::min(dt_s, 0.25f) : 0.0f;
  if (!pressed_) since_press_s_ += dt;
  out_.pressed = pressed_;
  pressed_ = false;
  out_.gesture = gesture_;
  gesture_ = body::GestureKind::none;
  feeling_.step(dt);
  const bool busy = since_press_s_ < kBusy_s || feeling_.current() != emotion::Emotion::calm;
  idle_.step(dt, std::max(attend_, since_press_s_ < 4.0f ? 1.0f : (busy ? 0.6f : 0.2f)));

  friendly_ += ((busy ? kFriendly : 0.0f) - friendly_) * std::min(1.0f, dt / kFriendlyTime_s);
  out_.emotions = feeling_.weights();
  out_.emotions[emotion::index_of(emotion::Emotion::joy)] += friendly_ * unfelt(feeling_.weights());
  out_.emotion = feeling_.current();
  out_.idle_face = idle_.face();
  out_.body = body::BapFrame{};
  idle_.apply(&out_.body);
  out_.covers_change = idle_.covers_change();
  out_.busy = busy;
  return out_;
}

}  // namespace caryatid::agent
