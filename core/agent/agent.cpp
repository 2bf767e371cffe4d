#include "core/agent/agent.h"

#include <algorithm>
#include <cstring>

namespace caryatid::agent {

int Programme::find(std::span<const char> name) const {
  for (std::size_t b = 0; b < buttons.size(); ++b) {
    const auto own = buttons[b].name.span();
    if (own.size() == name.size() && std::memcmp(own.data(), name.data(), name.size()) == 0)
      return static_cast<int>(b);
  }
  return -1;
}

Agent::Agent(const Programme* programme, std::uint64_t seed) : programme_(programme), idle_(seed) {}

void Agent::press(const Button& button) {
  feeling_.feel(button.feel);
  since_press_s_ = 0.0f;
}

void Agent::feel(emotion::Emotion e, float strength) {
  feeling_.hold(e, strength);
  since_press_s_ = 0.0f;
}

const Intentions& Agent::step(float dt_s, std::span<const ButtonEvent> events) {
  const float dt = dt_s > 0.0f ? std::min(dt_s, 0.25f) : 0.0f;
  since_press_s_ += dt;
  out_.pressed = false;
  for (const ButtonEvent& e : events)
    if (e.pressed && e.button >= 1 && e.button <= programme_->buttons.size()) {
      press(programme_->buttons[e.button - 1u]);
      out_.pressed = true;
    }
  feeling_.step(dt);
  const bool busy = since_press_s_ < kBusy_s || feeling_.current() != emotion::Emotion::calm;
  idle_.step(dt, since_press_s_ < 4.0f ? 1.0f : (busy ? 0.6f : 0.2f));

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
