#pragma once
// Four key poses become a cycle: joint curves through the keys, and the way of the pelvis over the
// standing foot, by the thesis's steps 3 (height) and 4 (no sliding), taken at every instant.
//
// Phases are shares of the cycle of one leg: 0 its heel strike, 0.5 the other's. "Step phase" is
// that of the leg in front, 0..0.5. Lengths in metres, angles in radians unless a name says deg.
#include <array>

#include "core/body/foot_roll.h"
#include "core/body/gait_style.h"

namespace caryatid::body {

enum class GaitInterpolation : std::uint8_t {
  smooth,  // Periodic cubic splines through the keys.
  linear,  // As in the thesis.
};

// What the gait needs to know of a body; one leg stands for both.
struct LegShape {
  float thigh_m = 0.0f, shank_m = 0.0f;
  float hip_half_width_m = 0.0f;
  FootShape foot;

  float length_m() const { return thigh_m + shank_m + foot.ankle.y; }
};
LegShape leg_shape(const Skeleton& skeleton);

class GaitCycle {
 public:
  GaitCycle(const GaitStyle& style, const LegShape& leg,
            GaitInterpolation interpolation = GaitInterpolation::smooth);

  // Pelvis (middle of the hips) relative to the standing foot's place: ahead, and above the floor.
  float forward_m(float step_phase) const;
  float height_m(float step_phase) const;
  float step_m() const { return step_m_; }
  // Of the pelvis to the side of the leg with that phase; and half the distance between the feet.
  float sway_m(float phase) const;
  float half_width_m() const { return half_width_m_; }

  // Pelvis: side of this leg up, side of this leg forward.
  float list(float phase) const { return signed_curve(list_, phase); }
  float rotation(float phase) const { return signed_curve(rotation_, phase); }

  float thigh(float phase) const { return curve(thigh_, phase); }
  float knee(float phase) const;
  // Distance from hip to ankle for a knee flexion.
  float reach_m(float knee) const;
  // Foot against the floor, toe up +. Until kPushOff as the keys want it, in the swing as well.
  float contact_pitch(float phase) const;
  float swing_pitch(float phase) const { return curve(pitch_, phase); }
  // Pitch of the foot at push-off, on the floor with the hip at (ahead of its place, above the
  // floor, beside), so that the knee is flexed as the keys want it. Never toe up.
  float push_off_pitch(Vec3 hip_from_place_m, float phase) const;
  // Ankle from the hip (ahead, up) in the swing.
  Vec2 swing_ankle(float phase) const;

  float contact() const { return contact_; }
  float toe_bend() const { return toe_bend_; }
  bool runs() const { return contact_ < 0.5f; }

  // From here on the hind foot yields to the pelvis instead of leading it.
  static constexpr float kPushOff = 0.375f;
  // The sole is flat from here on after the heel strike.
  static constexpr float kFootFlat = 0.12f;

 private:
  using Keys8 = std::array<float, 8>;
  struct Curve {
    Keys8 key{}, bend{};  // Values and second derivatives (per key interval squared).
  };
  Curve make_curve(const Keys8& keys) const;
  float curve(const Curve& c, float phase) const;
  float signed_curve(const Curve& c, float phase) const { return curve(c, phase); }
  float pelvis_height_over(float phase) const;
  void plan_way();
  void plan_height();

  LegShape leg_;
  GaitInterpolation interpolation_;
  Curve thigh_, knee_, pitch_, list_, rotation_;
  float contact_, toe_bend_, half_width_m_, sway_amplitude_m_, rise_rad_;
  float start_m_ = 0.0f, step_m_ = 0.0f;
  std::array<float, 4> wave_{};  // Deviation of the way from even speed: harmonics of a step.
  struct Height {
    float yield = kPushOff;  // Step phase at which the standing leg stops leading the pelvis,
    float loaded = 0.125f;   // and that at which the next one begins to.
    float begin = 0.0f, begin_slope = 0.0f;    // At `yield`,
    float middle = 0.0f, middle_slope = 0.0f;  // at 0 = 0.5,
    float end = 0.0f, end_slope = 0.0f;        // at `loaded`.
  } height_;
};

}  // namespace caryatid::body
