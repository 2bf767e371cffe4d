#include "core/body/gait_cycle.h"

#include <cmath>

#include "core/base/trig.h"
#include "core/body/ik.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = kPi / 180.0f;
constexpr float kReferenceLeg = 0.927f;  // The body that lengths of a GaitStyle are given for.
constexpr float kSlopeSpan = 1.0f / 256.0f;

float smooth(float x) {
  if (x <= 0.0f) return 0.0f;
  if (x >= 1.0f) return 1.0f;
  return x * x * (3.0f - 2.0f * x);
}

float square(float x) { return x * x; }
float root(float x) { return x > 0.0f ? std::sqrt(x) : 0.0f; }

// Hip to ankle in the sagittal plane.
Vec2 leg_vector(const LegShape& leg, float thigh, float knee) {
  const SinCos t = sin_cos(thigh);
  const SinCos s = sin_cos(thigh - knee);
  return {leg.thigh_m * t.sin + leg.shank_m * s.sin, -leg.thigh_m * t.cos - leg.shank_m * s.cos};
}

float hermite(float t, float span, const std::array<float, 4>& ends) {
  const float t2 = t * t, t3 = t2 * t;
  return ends[0] * (2 * t3 - 3 * t2 + 1) + ends[1] * span * (t3 - 2 * t2 + t) +
         ends[2] * (3 * t2 - 2 * t3) + ends[3] * span * (t3 - t2);
}

}  // namespace

LegShape leg_shape(const Skeleton& s) {
  return {
      .thigh_m = upper_length(s, leg(true)),
      .shank_m = lower_length(s, leg(true)),
      .hip_half_width_m = 0.5f * (s.center(HanimJoint::l_hip).x - s.center(HanimJoint::r_hip).x),
      .foot = foot_shape(s, true)};
}

GaitCycle::GaitCycle(const GaitStyle& style, const LegShape& leg, GaitInterpolation interpolation)
    : leg_(leg), interpolation_(interpolation) {
  Keys8 thigh, knee, pitch, list, rotation;
  for (std::size_t k = 0; k < 4; ++k) {
    thigh[k] = style.stance_thigh_deg[k] * kDegree;
    thigh[k + 4] = style.swing_thigh_deg[k] * kDegree;
    knee[k] = style.stance_knee_deg[k] * kDegree;
    knee[k + 4] = style.swing_knee_deg[k] * kDegree;
    pitch[k] = thigh[k] - knee[k] + style.stance_ankle_deg[k] * kDegree;
    pitch[k + 4] = thigh[k + 4] - knee[k + 4] + style.swing_ankle_deg[k] * kDegree;
    list[k] = style.list_deg[k] * kDegree;
    rotation[k] = style.rotation_deg[k] * kDegree;
    list[k + 4] = -list[k];
    rotation[k + 4] = -rotation[k];
  }
  const float scale = leg.length_m() / kReferenceLeg;
  contact_ = style.contact;
  toe_bend_ = style.toe_bend_deg * kDegree;
  half_width_m_ = 0.5f * style.step_width_m * scale;
  sway_amplitude_m_ = style.sway_m * scale;
  rise_rad_ = style.bounce_m / 0.15f;  // Over the lever of the foot, ankle to ball.
  thigh_ = make_curve(thigh);
  knee_ = make_curve(knee);
  pitch_ = make_curve(pitch);
  list_ = make_curve(list);
  rotation_ = make_curve(rotation);
  if (runs()) height_.yield = contact_ - kSlopeSpan;
  plan_way();
  plan_height();
}

// Second derivatives of the periodic cubic spline through 8 even keys: the inverse of the circulant
// (1, 4, 1) has the entries r^k + r^(8-k) over 2 sqrt(3) (1 - r^8), r = sqrt(3) - 2.
GaitCycle::Curve GaitCycle::make_curve(const Keys8& keys) const {
  constexpr std::array<float, 5> kInverse = {0.2886905f, -0.0773810f, 0.0208333f, -0.0059524f,
                                             0.0029762f};
  Curve c{keys, {}};
  if (interpolation_ == GaitInterpolation::linear) return c;
  Keys8 rhs;
  for (std::size_t i = 0; i < 8; ++i)
    rhs[i] = 6.0f * (keys[(i + 7) % 8] - 2.0f * keys[i] + keys[(i + 1) % 8]);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < 8; ++j) {
      const std::size_t d = (i + 8 - j) % 8;
      c.bend[i] += kInverse[d < 5 ? d : 8 - d] * rhs[j];
    }
  return c;
}

float GaitCycle::curve(const Curve& c, float phase) const {
  const float at = (phase - std::floor(phase)) * 8.0f;
  const std::size_t i = static_cast<std::size_t>(at) % 8;
  const float u = at - std::floor(at);
  const float v = 1.0f - u;
  const std::size_t j = (i + 1) % 8;
  return v * c.key[i] + u * c.key[j] +
         ((v * v * v - v) * c.bend[i] + (u * u * u - u) * c.bend[j]) * (1.0f / 6.0f);
}

float GaitCycle::knee(float phase) const {
  constexpr float kLeast = 1.5f * kDegree;  // A spline may undershoot; knees do not bend backwards.
  const float k = curve(knee_, phase);
  return k > kLeast ? k : kLeast;
}

float GaitCycle::reach_m(float knee) const {
  return root(square(leg_.thigh_m) + square(leg_.shank_m) +
              2.0f * leg_.thigh_m * leg_.shank_m * cos_of(knee));
}

float GaitCycle::sway_m(float phase) const {
  return sway_amplitude_m_ * sin_of(2.0f * kPi * phase);
}

float GaitCycle::contact_pitch(float phase) const {
  if (phase < kFootFlat) return pitch_.key[0] * square(1.0f - phase / kFootFlat);
  const float rise = rise_rad_ * smooth((phase - 0.14f) / 0.15f);
  const float heel_off = phase > 0.25f ? square((phase - 0.25f) / (kPushOff - 0.25f)) : 0.0f;
  return pitch_.key[3] * heel_off - rise;
}

Vec2 GaitCycle::swing_ankle(float phase) const {
  return leg_vector(leg_, thigh(phase), knee(phase));
}

// Height of the pelvis over the leg of that phase, standing with contact_pitch.
float GaitCycle::pelvis_height_over(float phase) const {
  const Vec2 ankle = roll_foot(leg_.foot, contact_pitch(phase), toe_bend_).ankle;
  const float ahead = forward_m(phase) + leg_.hip_half_width_m * sin_of(rotation(phase)) - ankle.x;
  const float beside = leg_.hip_half_width_m + sway_m(phase) - half_width_m_;
  const float hip = ankle.y + root(square(reach_m(knee(phase))) - square(ahead) - square(beside));
  return hip - leg_.hip_half_width_m * sin_of(list(phase));
}

// Step 4 of the thesis: what the standing foot would slide, the pelvis travels instead.
void GaitCycle::plan_way() {
  const auto pelvis_ahead = [&](float phase, float pitch) {
    const Vec2 ankle = roll_foot(leg_.foot, pitch, toe_bend_).ankle;
    return ankle.x - swing_ankle(phase).x - leg_.hip_half_width_m * sin_of(rotation(phase));
  };
  std::array<float, 5> way{};
  for (std::size_t k = 0; k < 4; ++k) {
    const float phase = float(k) / 8.0f;
    way[k] = pelvis_ahead(phase, contact_pitch(phase));
  }
  if (runs()) {
    // Speed of the stance carries through the flight.
    step_m_ = 0.5f * (way[3] - way[0]) / 0.375f;
    start_m_ = way[0];
    wave_ = {};
    return;
  }
  // The hind foot at 50 %: its heel is as high as the front leg keeps the hip.
  const float hip = roll_foot(leg_.foot, contact_pitch(0.0f), toe_bend_).ankle.y - swing_ankle(0).y;
  const Vec2 lever = leg_.foot.ankle - leg_.foot.metatarsal;
  const float needed = hip + swing_ankle(0.5f).y;
  const float lever_m = root(square(lever.x) + square(lever.y));
  const float pitch =
      atan2_of(lever.y, -lever.x) - asin_of((needed - leg_.foot.metatarsal.y) / lever_m);
  way[4] = pelvis_ahead(0.5f, pitch);
  if (pitch > 0.0f) {  // Too long even on a flat foot: the hip moves on until the leg fits.
    way[4] = root(square(reach_m(knee(0.5f))) - square(hip - leg_.foot.ankle.y)) -
             leg_.hip_half_width_m * sin_of(rotation(0.5f));
  }
  start_m_ = way[0];
  step_m_ = way[4] - way[0];
  std::array<float, 4> d{};
  for (std::size_t k = 0; k < 4; ++k) d[k] = way[k] - way[0] - step_m_ * float(k) / 4.0f;
  wave_ = {0.25f * (d[0] + d[1] + d[2] + d[3]), 0.5f * (d[0] - d[2]), 0.5f * (d[1] - d[3]),
           0.25f * (d[0] - d[1] + d[2] - d[3])};
}

float GaitCycle::forward_m(float step_phase) const {
  const SinCos t = sin_cos(4.0f * kPi * step_phase);
  const float wave =
      wave_[0] + wave_[1] * t.cos + wave_[2] * t.sin + wave_[3] * (t.cos * t.cos - t.sin * t.sin);
  return start_m_ + step_m_ * 2.0f * step_phase + wave;
}

// Step 3: the standing leg carries the pelvis from recoil to anticipation. Around the extended
// pose, where both feet can yield, an even curve leads from one leg over to the next.
void GaitCycle::plan_height() {
  constexpr float kFall = -0.25f;  // Of a run at contact, per cycle, for the reference leg.
  height_.begin = pelvis_height_over(height_.yield);
  height_.begin_slope =
      (height_.begin - pelvis_height_over(height_.yield - kSlopeSpan)) / kSlopeSpan;
  height_.middle = pelvis_height_over(0.0f);
  height_.end = pelvis_height_over(height_.loaded);
  height_.end_slope = (pelvis_height_over(height_.loaded + kSlopeSpan) - height_.end) / kSlopeSpan;
  const float before = 0.5f - height_.yield;
  height_.middle_slope =
      runs() ? kFall * leg_.length_m() / kReferenceLeg
             : 0.5f * (height_.end - height_.begin) / (before + height_.loaded) +
                   0.5f * (pelvis_height_over(kSlopeSpan) - height_.middle) / kSlopeSpan;
}

float GaitCycle::height_m(float step_phase) const {
  const Height& h = height_;
  if (step_phase < h.loaded)
    return hermite(step_phase / h.loaded, h.loaded, {h.middle, h.middle_slope, h.end, h.end_slope});
  if (step_phase < h.yield) return pelvis_height_over(step_phase);
  const float span = 0.5f - h.yield;
  return hermite((step_phase - h.yield) / span, span,
                 {h.begin, h.begin_slope, h.middle, h.middle_slope});
}

float GaitCycle::push_off_pitch(Vec3 hip, float phase) const {
  const float reach2 = square(reach_m(knee(phase)));
  // Distance falls as the heel rises; bisection, as toe bend makes the path piecewise.
  const auto too_far = [&](float pitch) {
    const Vec2 ankle = roll_foot(leg_.foot, pitch, toe_bend_).ankle;
    return square(hip.x - ankle.x) + square(hip.y - ankle.y) + square(hip.z) > reach2;
  };
  if (!too_far(0.0f)) return 0.0f;
  float flat = 0.0f, steep = -1.2f;  // Steeper, and a shoe would stand on its cap.
  for (int i = 0; i < 18; ++i) {
    const float middle = 0.5f * (flat + steep);
    (too_far(middle) ? flat : steep) = middle;
  }
  return 0.5f * (flat + steep);
}

}  // namespace caryatid::body
