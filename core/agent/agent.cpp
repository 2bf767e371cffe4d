#include "core/agent/agent.h"

#include <algorithm>

namespace caryatid::agent {

void Agent::press() {
  pressed_ = true;
  since_press_s_ = 0.0f;
}

void Agent::feel(emotion::Emotion e) { feeling_.feel(e); }

void Agent::feel(emotion::Emotion e, float strength) {
  feeling_.hold(e, strength);
  since_press_s_ = 0.0f;
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

  out_.emotions = feeling_.weights();
  out_.emotion = feeling_.current();
  out_.idle_face = idle_.face();
  out_.body = body::BapFrame{};
  idle_.apply(&out_.body);
  out_.covers_change = idle_.covers_change();
  out_.busy = busy;
  return out_;
}

}  // namespace caryatid::agent
