#include "core/body/walker.h"

#include <cmath>

#include "core/base/trig.h"
#include "core/body/ik.h"
#include "core/body/upper_body.h"

namespace caryatid::body {
namespace {

constexpr float kDegree = kPi / 180.0f;
constexpr float kTurnAtOnce = 60.0f * kDegree;    // More than this is turned on the spot first.
constexpr float kTurnPerStep = 40.0f * kDegree;   // On the spot.
constexpr float kSteerPerStep = 22.0f * kDegree;  // While walking.
constexpr float kArrivedM = 0.10f;
constexpr float kAlignedRad = 3.0f * kDegree;
constexpr float kStraightest = 0.8f * kDegree;  // Knee flexion that the height always leaves.
constexpr float kClearanceM = 0.016f;           // Of the sole in mid swing.
constexpr float kBrushM = 0.003f;
constexpr float kLegReferenceM = 0.927f;

float smooth(float x) {
  if (x <= 0.0f) return 0.0f;
  if (x >= 1.0f) return 1.0f;
  return x * x * (3.0f - 2.0f * x);
}
float clamped(float x, float low, float high) { return x < low ? low : (x > high ? high : x); }
float wrapped(float rad) { return rad - 2.0f * kPi * std::floor(rad / (2.0f * kPi) + 0.5f); }
float length(Vec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }
float square(float x) { return x * x; }
float side_of(bool left) { return left ? 1.0f : -1.0f; }

}  // namespace

Walker::Walker(const Skeleton* skeleton, Vec2 place, float heading_rad, std::uint64_t seed)
    : skeleton_(skeleton),
      shape_(leg_shape(*skeleton)),
      style_(gait_style(GaitMood::normal)),
      wanted_style_(style_),
      random_(seed),
      heading_(heading_rad),
      center_(place) {
  const GaitCycle cycle = cycle_at(0.0f);
  for (const bool left : {true, false}) {
    Foot& foot = foot_[left ? 0 : 1];
    foot.at = place + along(heading_, side_of(left) * cycle.half_width_m(), -cycle.forward_m(0));
    foot.yaw = heading_ + side_of(left) * style_.toe_out_deg * kDegree;
  }
}

void Walker::walk_to(Vec2 place, std::optional<float> facing_rad) {
  place_ = place;
  facing_ = facing_rad;
  stop_ = false;
}

void Walker::face(float heading_rad) {
  place_.reset();
  facing_ = heading_rad;
  stop_ = true;
}

void Walker::stop() {
  place_.reset();
  facing_.reset();
  stop_ = true;
}

float Walker::left_phase() const { return left_stands_ ? step_phase_ : step_phase_ + 0.5f; }

// (left, ahead) of a body with that heading, on the floor.
Vec2 Walker::along(float heading, float left_m, float ahead_m) const {
  const SinCos h = sin_cos(heading);
  return {h.cos * left_m + h.sin * ahead_m, -h.sin * left_m + h.cos * ahead_m};
}

GaitStyle Walker::style_at(float vigour) const {
  GaitStyle still = standing_style();
  // Bearing is of the mood, standing or walking.
  still.trunk_pitch_deg = style_.trunk_pitch_deg;
  still.head_pitch_deg = style_.head_pitch_deg;
  still.chest_pitch_deg = style_.chest_pitch_deg;
  still.shoulders_forward_deg = style_.shoulders_forward_deg;
  still.shoulders_up_deg = style_.shoulders_up_deg;
  still.finger_curl_deg = style_.finger_curl_deg;
  // Arms swing past the hips, but hang beside them.
  still.arm_out_deg += style_.arm_out_deg - gait_style(GaitMood::normal).arm_out_deg;
  still.toe_out_deg = style_.toe_out_deg;
  return blend(still, style_, vigour);
}

GaitCycle Walker::cycle_at(float vigour) const {
  return GaitCycle(style_at(vigour), shape_, interpolation_);
}

float Walker::vigour_at(float step_phase) const {
  const float s = (step_phase - plan_.ramp_begin) / (plan_.ramp_end - plan_.ramp_begin);
  return plan_.vigour0 + (plan_.vigour1 - plan_.vigour0) * smooth(s);
}

// Where the cycle wants the middle of the hips over the standing foot.
Vec2 Walker::planned_center(const GaitCycle& cycle, float step_phase, float heading) const {
  const float side = side_of(left_stands_);
  const Foot& stance = foot_[left_stands_ ? 0 : 1];
  const float left = side * (cycle.sway_m(step_phase) - cycle.half_width_m());
  return stance.at + along(heading, left, cycle.forward_m(step_phase));
}

// What to do with the next step, while walking towards a place. False: nothing to do.
bool Walker::plan_walk(float* heading_end) {
  const Vec2 way = *place_ - center_;
  const float distance = length(way);
  const float full = cycle_at(1.0f).step_m();
  const float steps = distance / full - 0.5f * plan_.vigour0;  // Full ones, after the present half.
  if (plan_.vigour0 == 0.0f && distance < kArrivedM) {
    place_.reset();
    return false;
  }
  const float aside = wrapped(atan2_of(way.x, way.y) - heading_);
  if (plan_.vigour0 == 0.0f && std::abs(aside) > kTurnAtOnce) {
    *heading_end = heading_ + clamped(aside, -kTurnPerStep, kTurnPerStep);
    return true;
  }
  if (steps > 0.12f && std::abs(aside) < 0.5f * kPi) {
    const float count = std::ceil(steps - 0.05f) < 1.0f ? 1.0f : std::ceil(steps - 0.05f);
    plan_.vigour1 = clamped(steps / count, 0.0f, 1.0f);
    const float near_by = distance < 1.5f * full ? distance / (1.5f * full) : 1.0f;
    *heading_end = heading_ + near_by * clamped(aside, -kSteerPerStep, kSteerPerStep);
  }
  return true;
}

// Decides the step that begins now with vigour_ and heading_; false when there is none to take.
bool Walker::plan_step() {
  plan_ = Plan{.vigour0 = vigour_, .heading0 = heading_, .heading1 = heading_};
  bool moving = vigour_ > 0.0f;
  if (place_ && plan_walk(&plan_.heading1)) moving = true;
  if (!place_ && facing_ && vigour_ == 0.0f) {
    const float aside = wrapped(*facing_ - heading_);
    if (std::abs(aside) > kAlignedRad) {
      const float count = std::ceil(std::abs(aside) / kTurnPerStep);
      plan_.heading1 = heading_ + aside / count;
      moving = true;
    }
  }
  if (!moving) {  // Bring the feet together, if they are not.
    const GaitCycle still = cycle_at(0.0f);
    for (const bool left : {true, false}) {
      const Foot& foot = foot_[left ? 0 : 1];
      const float out = side_of(left) * style_.toe_out_deg * kDegree;
      const Vec2 home =
          center_ + along(heading_, side_of(left) * still.half_width_m(), -still.forward_m(0.0f));
      if (std::abs(wrapped(foot.yaw - heading_ - out)) > 8.0f * kDegree ||
          length(foot.at - home) > 0.06f)
        moving = true;
    }
  }
  if (!moving && facing_ && !place_) facing_.reset();
  if (plan_.vigour0 == 0.0f) {
    plan_.ramp_begin = 0.18f;
  } else if (plan_.vigour1 == 0.0f) {
    plan_.ramp_end = 0.38f;
  }
  return moving;
}

void Walker::begin_step(bool left_stands) {
  left_stands_ = left_stands;
  step_phase_ = 0.0f;
  plan_.from_standing = standing_;
  standing_ = false;
  plan_.error0 = center_ - planned_center(cycle_at(plan_.vigour0), 0.0f, heading_);
  if (plan_.vigour1 > 0.0f) return;
  // A step that ends the walk, or one on the spot, ends where it should.
  const Vec2 end = planned_center(cycle_at(0.0f), 0.5f, plan_.heading1);
  const Vec2 wanted =
      place_ && plan_.vigour0 > 0.0f ? *place_ : (plan_.vigour0 > 0.0f ? end : center_);
  const Vec2 error = wanted - end;
  const float m = length(error);
  plan_.error1 = m > 0.15f ? error * (0.15f / m) : error;
}

void Walker::land() {
  step_phase_ -= 0.5f;
  vigour_ = plan_.vigour1;
  heading_ = plan_.heading1;
  const GaitCycle cycle = cycle_at(vigour_);
  center_ = planned_center(cycle, 0.5f, heading_) + plan_.error1;
  const bool left = !left_stands_;
  Foot& foot = foot_[left ? 0 : 1];
  const float side = side_of(left);
  foot.at = center_ + along(heading_, side * cycle.half_width_m(), -cycle.forward_m(0.0f));
  foot.yaw = heading_ + side * style_.toe_out_deg * kDegree;
  foot.planted = true;
  const float rest = step_phase_;
  if (plan_step()) {
    begin_step(left);
    step_phase_ = rest;
  } else {
    standing_ = true;
    left_stands_ = left;
    step_phase_ = 0.0f;
    const GaitCycle still = cycle_at(0.0f);
    const Vec2 middle = 0.5f * (foot_[0].at + foot_[1].at);
    drift_ = center_ - middle - along(heading_, 0.0f, still.forward_m(0.0f));
  }
}

// From a world point to (left, up, ahead) of a hip, in the frame of the heading.
Vec3 Walker::hip_local(const LowerBody& body, bool left, Vec3 world) const {
  return rotation_y(-body.heading_rad) * (world - hip_position(*skeleton_, body, left));
}

FootTarget Walker::planted_foot(const Foot& foot, float pitch) const {
  const float bend = style_.toe_bend_deg * kDegree;
  const FootRoll roll = roll_foot(shape_.foot, pitch, bend);
  const Vec2 ankle = foot.at + along(foot.yaw, 0.0f, roll.ankle.x);
  return {.ankle_m = {ankle.x, roll.ankle.y, ankle.y},
          .yaw_rad = foot.yaw,
          .pitch_rad = pitch,
          .toe_extension_rad = roll.toe_extension_rad};
}

// A leg that keeps its knee must not carry the pelvis higher than it can reach.
void Walker::limit_height(LowerBody& body, bool left, float pitch) const {
  const FootTarget foot = planted_foot(foot_[left ? 0 : 1], pitch);
  const Vec3 hip = hip_position(*skeleton_, body, left);
  const float reach2 = square(shape_.thigh_m) + square(shape_.shank_m) +
                       2.0f * shape_.thigh_m * shape_.shank_m * cos_of(kStraightest);
  const float level2 = square(hip.x - foot.ankle_m.x) + square(hip.z - foot.ankle_m.z);
  const float rise = reach2 > level2 ? std::sqrt(reach2 - level2) : 0.0f;
  const float excess = hip.y - foot.ankle_m.y - rise;
  if (excess > 0.0f) body.hips_m.y -= excess;
}

FootTarget Walker::contact_foot(const GaitCycle& cycle, const LowerBody& body, bool left,
                                float phase) {
  Foot& foot = foot_[left ? 0 : 1];
  float pitch = 0.0f;
  if (phase < GaitCycle::kPushOff || cycle.runs()) {
    pitch = cycle.contact_pitch(phase);
  } else {
    const Vec3 hip = hip_position(*skeleton_, body, left);
    const Vec2 from = Vec2{hip.x, hip.z} - foot.at;
    const SinCos yaw = sin_cos(foot.yaw);
    pitch = cycle.push_off_pitch(
        {from.x * yaw.sin + from.y * yaw.cos, hip.y, from.x * yaw.cos - from.y * yaw.sin}, phase);
    if (plan_.from_standing) pitch *= smooth((phase - 0.5f) / 0.12f);
  }
  const FootTarget target = planted_foot(foot, pitch);
  foot.pitch = pitch;
  foot.toe = target.toe_extension_rad;
  if (phase < GaitCycle::kFootFlat && !cycle.runs()) {
    foot.toe = 0.5f * pitch;  // Toes are held up until the sole is down.
  }
  foot.swing_yaw = foot.yaw;
  const Vec2 curve = cycle.swing_ankle(phase);
  foot.off_m = hip_local(body, left, target.ankle_m) - Vec3{0.0f, curve.y, curve.x};
  foot.planted = true;
  FootTarget out = target;
  out.toe_extension_rad = foot.toe;
  return out;
}

FootTarget Walker::swing_foot(const GaitCycle& cycle, const LowerBody& body, bool left,
                              float phase) {
  Foot& foot = foot_[left ? 0 : 1];
  foot.planted = false;
  const float s = clamped((phase - cycle.contact()) / (1.0f - cycle.contact()), 0.0f, 1.0f);
  const float share = smooth(s);
  const float side = side_of(left);
  // Where it will land, seen from where its hip will be then.
  Vec3 land_off{foot.off_m.x, 0.0f, 0.0f};
  float land_yaw = foot.swing_yaw + (plan_.heading1 - plan_.heading0);
  std::optional<Vec3> landing;
  if (left != left_stands_) {
    // In a steady walk the cycle at the landing is the present one.
    const GaitCycle end = plan_.vigour1 == vigour_ ? cycle : cycle_at(plan_.vigour1);
    const Vec2 center = planned_center(end, 0.5f, plan_.heading1) + plan_.error1;
    LowerBody then{.hips_m = {center.x, end.height_m(0.5f), center.y},
                   .heading_rad = plan_.heading1,
                   .torsion_rad = -side * end.rotation(0.0f),
                   .roll_rad = side * end.list(0.0f)};
    Foot landed = foot;
    landed.at = center + along(plan_.heading1, side * end.half_width_m(), -end.forward_m(0.0f));
    landed.yaw = plan_.heading1 + side * style_.toe_out_deg * kDegree;
    land_yaw = landed.yaw;
    const FootTarget target = planted_foot(landed, end.contact_pitch(0.0f));
    landing = target.ankle_m;
    const Vec2 curve = end.swing_ankle(0.0f);
    land_off = hip_local(then, left, target.ankle_m) - Vec3{0.0f, curve.y, curve.x};
  }
  const Vec3 off = foot.off_m * (1.0f - share) + land_off * share;
  const Vec2 curve = cycle.swing_ankle(phase);
  const Vec3 local = Vec3{0.0f, curve.y, curve.x} + off;
  FootTarget target;
  target.ankle_m = hip_position(*skeleton_, body, left) + rotation_y(body.heading_rad) * local;
  if (landing) {  // Comes to rest over its place before it touches.
    const float over = smooth((s - 0.93f) / 0.055f);
    target.ankle_m.x += (landing->x - target.ankle_m.x) * over;
    target.ankle_m.z += (landing->z - target.ankle_m.z) * over;
  }
  target.yaw_rad = foot.swing_yaw + wrapped(land_yaw - foot.swing_yaw) * share;
  target.pitch_rad = cycle.swing_pitch(phase) +
                     (foot.pitch - cycle.swing_pitch(cycle.contact())) * (1.0f - smooth(s / 0.5f));
  const float strike_toe = 0.5f * clamped(cycle.contact_pitch(0.0f), 0.0f, 1.0f);
  target.toe_extension_rad =
      foot.toe * (1.0f - smooth(s / 0.45f)) + strike_toe * smooth((s - 0.3f) / 0.7f);
  // Clear the floor: a rounded maximum of where the foot is and where it may be.
  const float low = lowest_point(shape_.foot, {0.0f, target.ankle_m.y}, target.pitch_rad,
                                 target.toe_extension_rad);
  // Towards the landing it sinks, but does not brush the floor before it has come to rest above it.
  const float sink = clamped((1.0f - s) / 0.35f, 0.0f, 1.0f);
  const float brush = kBrushM * clamped((1.0f - s) / 0.03f, 0.0f, 1.0f);
  const float above = kClearanceM * sink > brush ? kClearanceM * sink : brush;
  const float room = above * smooth(s / 0.12f);
  const float gap = room - low;
  const float round = 0.25f * room;
  target.ankle_m.y += 0.5f * (gap + std::sqrt(gap * gap + round * round));
  return target;
}

void Walker::walk(float dt_s, LowerBody& body) {
  const float scale =
      std::sqrt(shape_.length_m() / kLegReferenceM);  // Froude: slower on long legs.
  step_phase_ += dt_s / (style_at(vigour_).cycle_s * scale);
  if (step_phase_ >= 0.5f) land();
  if (standing_) return;
  vigour_ = vigour_at(step_phase_);
  const GaitCycle cycle = cycle_at(vigour_);
  const float turn = smooth((step_phase_ - 0.08f) / 0.42f);
  heading_ = plan_.heading0 + (plan_.heading1 - plan_.heading0) * turn;
  const float done = smooth(2.0f * step_phase_);
  center_ = planned_center(cycle, step_phase_, heading_) + plan_.error0 * (1.0f - done) +
            plan_.error1 * done;
  const float side = side_of(left_stands_);
  body.heading_rad = heading_;
  body.torsion_rad = -side * cycle.rotation(step_phase_);
  body.roll_rad = side * cycle.list(step_phase_);
  body.hips_m = {center_.x, cycle.height_m(step_phase_), center_.y};
  if (step_phase_ < cycle.contact() && step_phase_ < GaitCycle::kPushOff)
    limit_height(body, left_stands_, cycle.contact_pitch(step_phase_));
  for (const bool left : {true, false}) {
    const float phase = left == left_stands_ ? step_phase_ : step_phase_ + 0.5f;
    body.foot[left ? 0 : 1] = phase < cycle.contact() ? contact_foot(cycle, body, left, phase)
                                                      : swing_foot(cycle, body, left, phase);
  }
}

void Walker::stand(float dt_s, LowerBody& body) {
  constexpr float kShiftS = 1.4f;  // Duration of a weight shift.
  shift_clock_s_ += dt_s;
  if (shift_clock_s_ > kShiftS + shift_rest_s_) {
    shift_clock_s_ = 0.0f;
    shift_from_ = shift_to_;
    const float choice = random_.unit();
    shift_to_ = choice < 0.3f ? 0.0f : (shift_from_ > 0.0f ? -1.0f : 1.0f) * (0.6f + 0.4f * choice);
    shift_rest_s_ = random_.between(3.0f, 9.0f);
  }
  shift_ = shift_from_ + (shift_to_ - shift_from_) * smooth(shift_clock_s_ / kShiftS);
  drift_ *= 1.0f / (1.0f + 4.0f * dt_s);
  const GaitCycle still = cycle_at(0.0f);
  const float scale = shape_.length_m() / kLegReferenceM;
  const Vec2 middle = 0.5f * (foot_[0].at + foot_[1].at);
  center_ = middle + along(heading_, 0.035f * scale * shift_, still.forward_m(0.0f)) + drift_;
  body.heading_rad = heading_;
  body.torsion_rad = 0.03f * shift_;
  body.roll_rad = 2.2f * kDegree * shift_;
  body.hips_m = {center_.x, still.height_m(0.0f), center_.y};
  for (const bool left : {true, false}) limit_height(body, left, 0.0f);
  for (const bool left : {true, false}) {
    Foot& foot = foot_[left ? 0 : 1];
    body.foot[left ? 0 : 1] = planted_foot(foot, 0.0f);
    foot.planted = true;
    foot.pitch = foot.toe = 0.0f;
    foot.swing_yaw = foot.yaw;
  }
}

void Walker::step(float dt_s, BapFrame& out) {
  const float dt = clamped(dt_s, 0.0f, 0.1f);
  style_ = blend(style_, wanted_style_, dt / (0.35f + dt));
  LowerBody body;
  if (standing_ && (place_ || facing_) && std::abs(shift_ - shift_to_) < 0.05f) {
    vigour_ = 0.0f;
    if (plan_step()) {
      // The foot on the side of the turn opens it; otherwise the one without weight.
      const float turn = plan_.heading1 - plan_.heading0;
      begin_step(turn != 0.0f ? turn < 0.0f : shift_ >= 0.0f);
    }
  }
  if (standing_) {
    stand(dt, body);
  } else {
    shift_to_ = shift_ = shift_from_ = 0.0f;
    shift_clock_s_ = 0.0f;
    walk(dt, body);
    if (standing_) stand(0.0f, body);
  }
  slow_phase_ += standing_ ? 0.0f : 0.5f * dt / style_.cycle_s;
  slow_phase_ -= std::floor(slow_phase_);
  pose_upper_body(*skeleton_, style_at(vigour_), left_phase(), slow_phase_, vigour_, out);
  missed_m_ = pose_lower_body(*skeleton_, body, out);
}

}  // namespace caryatid::body
