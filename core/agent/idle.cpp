#include "core/agent/idle.h"

#include <algorithm>
#include <cmath>

#include "core/base/trig.h"

namespace caryatid::agent {
namespace {

constexpr float kDegree = kPi / 180.0f;
constexpr float kAnglesPerRadian = 1e5f;  // FAP and BAP angles are 1e-5 rad.

// Closing, held and opening times of a blink (spontaneous blinks, VanderWerf et al. 2003).
constexpr float kBlinkClose_s = 0.08f, kBlinkHold_s = 0.03f, kBlinkOpen_s = 0.16f;

float smooth(float t) { return t * t * (3.0f - 2.0f * t); }

}  // namespace

float Wander::step(float dt_s, Random* random) {
  left_s_ -= dt_s;
  if (left_s_ <= 0.0f) {
    target_ = random->between(-1.0f, 1.0f);
    left_s_ = period_s_ * random->between(0.5f, 1.5f);
  }
  // Critically damped spring, integrated exactly over the step, so that frame rate does not matter.
  const float omega = 4.0f / period_s_;
  const float decay = exp_of(-omega * dt_s);
  const float offset = value_ - target_;
  const float slope = velocity_ + omega * offset;
  value_ = target_ + (offset + slope * dt_s) * decay;
  velocity_ = (velocity_ - omega * slope * dt_s) * decay;
  return value_;
}

void inhale(float chest, body::BapFrame* io) {
  const auto add = [io](int bap, float degrees) {
    io->set(bap, io->get(bap) + degrees * kDegree * kAnglesPerRadian);
  };
  // Breath opens the chest: vt6 and vt10 lean back (tilts turn about -X), vc7 gives it back so that
  // the head stays; the clavicles rise (abduction is about +Z on both sides).
  add(89, 0.5f * chest);   // vt6_tilt
  add(101, 0.3f * chest);  // vt10_tilt
  add(71, -0.8f * chest);  // vc7_tilt
  add(24, 0.9f * chest);   // l_sternoclavicular_abduct
  add(25, -0.9f * chest);  // r_sternoclavicular_abduct
}

void Blinker::blink_now() {
  if (clock_s_ < 0.0f) clock_s_ = 0.0f;
}

float Blinker::step(float dt_s, Random* random) {
  if (clock_s_ < 0.0f) {
    until_next_s_ -= dt_s;
    if (until_next_s_ > 0.0f) return closure_ = 0.0f;
    clock_s_ = 0.0f;
    double_ = random->unit() < 0.125f;
  }
  clock_s_ += dt_s;
  if (clock_s_ < kBlinkClose_s) return closure_ = smooth(clock_s_ / kBlinkClose_s);
  if (clock_s_ < kBlinkClose_s + kBlinkHold_s) return closure_ = 1.0f;
  const float opening = (clock_s_ - kBlinkClose_s - kBlinkHold_s) / kBlinkOpen_s;
  if (opening < 1.0f) return closure_ = 1.0f - smooth(opening);
  clock_s_ = -1.0f;
  // Product of two uniforms in the exponent: a long tail without libm.
  until_next_s_ = double_ ? 0.12f : 1.6f * exp_of(1.7f * random->unit() * (0.5f + random->unit()));
  double_ = false;
  return closure_ = 0.0f;
}

Gaze Saccades::step(float dt_s, Random* random, float attention) {
  large_jump_ = false;
  until_next_s_ -= dt_s;
  if (until_next_s_ <= 0.0f) {
    from_ = now_;
    const bool aside = random->unit() > 0.8f + 0.2f * attention;
    // The triangle of eyes and mouth of a visitor at arm's length spans a few degrees.
    const float yaw = aside ? random->between(-14.0f, 14.0f) : random->between(-1.8f, 1.8f);
    const float pitch = aside ? random->between(-4.0f, 9.0f) : random->between(-0.8f, 1.6f);
    to_ = {yaw * kDegree, pitch * kDegree};
    const float dy = to_.yaw_rad - from_.yaw_rad, dp = to_.pitch_rad - from_.pitch_rad;
    const float size_deg = std::sqrt(dy * dy + dp * dp) / kDegree;
    duration_s_ = 0.021f + 0.0022f * size_deg;
    clock_s_ = 0.0f;
    large_jump_ = size_deg > 6.0f;
    until_next_s_ = aside ? random->between(0.4f, 1.2f) : random->between(0.5f, 3.0f);
  }
  clock_s_ += dt_s;
  const float t = smooth(std::min(clock_s_ / std::max(duration_s_, 1e-3f), 1.0f));
  now_.yaw_rad = from_.yaw_rad + (to_.yaw_rad - from_.yaw_rad) * t;
  now_.pitch_rad = from_.pitch_rad + (to_.pitch_rad - from_.pitch_rad) * t;
  return now_;
}

void IdleLife::step(float dt_s, float attention) {
  gaze_ = saccades_.step(dt_s, &random_, attention);
  if (saccades_.large_jump() && random_.unit() < 0.5f) blinker_.blink_now();
  blinker_.step(dt_s, &random_);
  for (Wander* w : {&head_yaw_, &head_pitch_, &head_roll_, &sway_side_, &sway_front_, &brow_})
    w->step(dt_s, &random_);
  const float follow = 1.0f - exp_of(-3.0f * dt_s);
  head_gaze_.yaw_rad += (0.35f * gaze_.yaw_rad - head_gaze_.yaw_rad) * follow;
  head_gaze_.pitch_rad += (0.3f * gaze_.pitch_rad - head_gaze_.pitch_rad) * follow;
  breath_phase_ += breath_rate_hz_ * dt_s;
  if (breath_phase_ >= 1.0f) {
    breath_phase_ -= 1.0f;
    breath_rate_hz_ = random_.between(0.2f, 0.3f);  // 12 to 18 breaths a minute at rest.
    breath_depth_ = random_.between(0.7f, 1.2f);
  }
}

face::FapFrame IdleLife::face() const {
  face::FapFrame faps;
  const float yaw = head_gaze_.yaw_rad + head_yaw_.value() * 1.3f * kDegree;
  const float pitch = head_gaze_.pitch_rad + head_pitch_.value() * 0.9f * kDegree;
  faps.set(48, pitch * kAnglesPerRadian);
  faps.set(49, yaw * kAnglesPerRadian);
  faps.set(50, head_roll_.value() * 0.8f * kDegree * kAnglesPerRadian);
  // The eyes hold their aim while the head moves (vestibulo-ocular reflex).
  for (const int fap : {23, 24}) faps.set(fap, (gaze_.yaw_rad - yaw) * kAnglesPerRadian);
  for (const int fap : {25, 26}) faps.set(fap, (gaze_.pitch_rad - pitch) * kAnglesPerRadian);
  for (const int fap : {31, 32, 33, 34}) faps.set(fap, brow_.value() * 9.0f);
  for (const int fap : {19, 20}) faps.set(fap, blinker_.closure() * 1024.0f);
  return faps;
}

void IdleLife::apply(body::BapFrame* baps) const {
  // Inspiration takes 40 % of a breath, expiration 60 %.
  const float p = breath_phase_;
  const float chest =
      breath_depth_ * (p < 0.4f ? smooth(p / 0.4f) : 1.0f - smooth((p - 0.4f) / 0.6f));
  const auto add = [baps](int bap, float degrees) {
    baps->set(bap, baps->get(bap) + degrees * kDegree * kAnglesPerRadian);
  };
  inhale(chest, baps);
  // Sway: the trunk over the hips, the neck against it.
  add(108, 0.5f * sway_side_.value());    // vl1_roll
  add(110, 0.35f * sway_front_.value());  // vl1_tilt
  add(69, -0.4f * sway_side_.value());    // vc7_roll
}

}  // namespace caryatid::agent
