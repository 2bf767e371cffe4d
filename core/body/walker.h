#pragma once
// A person on her feet: stands, shifts her weight, walks to a place, turns, faces the visitor, with
// the mood of any GaitStyle. A foot that stands does not move, whatever the rest of the body does:
// pelvis and steps are planned, legs follow by inverse kinematics.
//
// Frame: the stage's, right-handed, metres, floor y = 0; headings about +Y, 0 along +Z, left +.
// Deterministic for a seed and a sequence of time steps; fixed memory; about 5 microseconds a step.
#include <array>
#include <optional>

#include "core/base/random.h"
#include "core/body/bap.h"
#include "core/body/gait_cycle.h"
#include "core/body/legs.h"

namespace caryatid::body {

class Walker {
 public:
  // Borrows the skeleton. Stands at `place` (x, z) with the given heading.
  explicit Walker(const Skeleton* skeleton, Vec2 place = {0, 0}, float heading_rad = 0.0f,
                  std::uint64_t seed = 1);

  // The bearing and walk from now on; taken on smoothly over about half a second.
  void set_style(const GaitStyle& style) { wanted_style_ = style; }
  // Goes to the place, on the straightest way, ends with both feet together, and then faces
  // `facing_rad` if given. Replaces what was wanted before.
  void walk_to(Vec2 place, std::optional<float> facing_rad = std::nullopt);
  // Turns on the spot (after the present walk has stopped).
  void face(float heading_rad);
  // Ends the walk with the next step.
  void stop();

  // Advances by dt_s (cut to 0.1 s) and writes every BAP of the body, root included.
  void step(float dt_s, BapFrame& out);

  bool standing() const { return standing_; }
  bool arrived() const { return standing_ && !place_ && !facing_; }
  Vec2 place() const { return center_; }  // Of the body, on the floor (x, z).
  float heading_rad() const { return heading_; }
  // Walking speed as a share of the style's full stride, 0..1.
  float vigour() const { return vigour_; }
  // Share of the left leg's cycle; holds its value while standing.
  float left_phase() const;
  bool foot_planted(bool left) const { return foot_[left ? 0 : 1].planted; }
  // Of the last step(): how far a foot missed its place because the leg was too short.
  float missed_m() const { return missed_m_; }

  // Linear interpolation of the key poses, as in the thesis.
  void set_interpolation(GaitInterpolation interpolation) { interpolation_ = interpolation; }

 private:
  struct Foot {
    Vec2 at{0};  // Point of the floor under the ankle when the sole is flat (x, z).
    float yaw = 0.0f;
    bool planted = true;
    // At the last contact: how the foot lay, and what its ankle was off the swing curve.
    float pitch = 0.0f, toe = 0.0f, swing_yaw = 0.0f;
    Vec3 off_m{0};
  };
  struct Plan {  // Of the present step.
    float vigour0 = 0.0f, vigour1 = 0.0f;
    float ramp_begin = 0.0f, ramp_end = 0.5f;  // Step phases between which vigour changes.
    float heading0 = 0.0f, heading1 = 0.0f;
    Vec2 error0{0}, error1{0};  // Of the pelvis against the cycle, at begin and end.
    bool from_standing = false;
  };

  GaitCycle cycle_at(float vigour) const;
  GaitStyle style_at(float vigour) const;
  float hip_width() const { return shape_.hip_half_width_m; }
  Vec2 along(float heading, float left_m, float ahead_m) const;
  Vec2 planned_center(const GaitCycle& cycle, float step_phase, float heading) const;
  float vigour_at(float step_phase) const;
  void begin_step(bool left_stands);
  bool plan_step();
  bool plan_walk(float* heading_end);
  void land();
  void stand(float dt_s, LowerBody& body);
  void walk(float dt_s, LowerBody& body);
  FootTarget planted_foot(const Foot& foot, float pitch) const;
  FootTarget contact_foot(const GaitCycle& cycle, const LowerBody& body, bool left, float phase);
  FootTarget swing_foot(const GaitCycle& cycle, const LowerBody& body, bool left, float phase);
  Vec3 hip_local(const LowerBody& body, bool left, Vec3 world) const;
  void limit_height(LowerBody& body, bool left, float pitch) const;

  const Skeleton* skeleton_;
  LegShape shape_;
  GaitStyle style_, wanted_style_;
  GaitInterpolation interpolation_ = GaitInterpolation::smooth;
  Random random_;
  std::optional<Vec2> place_;
  std::optional<float> facing_;
  bool stop_ = false;

  std::array<Foot, 2> foot_;
  Plan plan_;
  bool standing_ = true;
  bool left_stands_ = true;  // Which foot carries the present step.
  float step_phase_ = 0.0f;  // 0..0.5
  float slow_phase_ = 0.0f;  // 0..1 over two cycles.
  float vigour_ = 0.0f;
  float heading_ = 0.0f;
  Vec2 center_{0};
  Vec2 drift_{0};  // Standing: of the pelvis against the middle of the feet.
  float shift_ = 0.0f, shift_from_ = 0.0f, shift_to_ = 0.0f;  // Weight: left + .. right -.
  float shift_clock_s_ = 0.0f, shift_rest_s_ = 3.0f;
  float missed_m_ = 0.0f;
};

}  // namespace caryatid::body
