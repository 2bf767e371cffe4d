#include "core/emotion/feeling.h"

#include <algorithm>

namespace caryatid::emotion {
namespace {

// Rises at once (the first frame already shows it) and lands softly: cubic ease-out.
float ease(float t) {
  const float left = 1.0f - t;
  return 1.0f - left * left * left;
}

constexpr float kHeldForever_s = 1e9f;

}  // namespace

Timing timing(Emotion e) {
  switch (e) {
    case Emotion::surprise:
      return {0.15f, 1.6f, 0.9f};
    case Emotion::fear:
      return {0.3f, 2.6f, 1.2f};
    case Emotion::anger:
      return {0.35f, 3.0f, 1.2f};
    case Emotion::disgust:
      return {0.4f, 2.6f, 1.0f};
    case Emotion::sadness:
      return {0.6f, 3.6f, 1.2f};
    case Emotion::joy:
      return {0.4f, 3.2f, 1.0f};
    case Emotion::calm:
      break;
  }
  return {0.4f, 0.5f, 0.6f};
}

void Feeling::move_to(Emotion e, float target, float duration_s) {
  const std::size_t i = index_of(e);
  if (target_[i] == target && duration_s_[i] > 0.0f) return;  // Already on its way.
  from_[i] = weights_[i];
  target_[i] = target;
  clock_s_[i] = 0.0f;
  duration_s_[i] = duration_s;
}

void Feeling::release_others(Emotion keep) {
  for (std::size_t i = 1; i < kEmotionCount; ++i)
    if (const auto e = static_cast<Emotion>(i); e != keep && target_[i] != 0.0f)
      // A new feeling pushes the old one out in the time that it needs to come, not slower.
      move_to(e, 0.0f, keep == Emotion::calm ? timing(e).offset_s : timing(keep).onset_s + 0.2f);
}

void Feeling::begin(Emotion e, float strength, float apex_s) {
  release_others(e);
  current_ = e;
  strength_ = e == Emotion::calm ? 0.0f : strength;
  phase_ = e == Emotion::calm ? Phase::rest : Phase::up;
  apex_left_s_ = apex_s;
  since_press_s_ = 0.0f;
  if (e != Emotion::calm) move_to(e, strength, timing(e).onset_s);
}

void Feeling::feel(Emotion e) {
  const bool again = e == current_ && phase_ == Phase::up && since_press_s_ <= kStrongerWindow_s;
  const Timing t = timing(e);
  begin(e, again ? kFullStrength : kFirstStrength, t.onset_s + t.apex_s);
}

void Feeling::hold(Emotion e, float strength) {
  begin(e, std::clamp(strength, 0.0f, 1.0f), kHeldForever_s);
}

void Feeling::step(float dt_s) {
  since_press_s_ += dt_s;
  if (phase_ == Phase::up) {
    apex_left_s_ -= dt_s;
    if (apex_left_s_ <= 0.0f) {
      phase_ = Phase::rest;
      strength_ = 0.0f;
      move_to(current_, 0.0f, timing(current_).offset_s);
    }
  }
  for (std::size_t i = 1; i < kEmotionCount; ++i) {
    if (duration_s_[i] <= 0.0f) continue;
    clock_s_[i] = std::min(clock_s_[i] + dt_s, duration_s_[i]);
    weights_[i] = from_[i] + (target_[i] - from_[i]) * ease(clock_s_[i] / duration_s_[i]);
    if (clock_s_[i] == duration_s_[i]) {
      weights_[i] = target_[i];
      duration_s_[i] = 0.0f;
    }
  }
}

}  // namespace caryatid::emotion
