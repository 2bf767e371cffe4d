#include "core/agent/stage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/trig.h"
#include "core/body/ik.h"
#include "core/body/pose.h"
#include "core/emotion/place.h"

namespace caryatid::agent {
namespace {

using body::HanimJoint;

constexpr float kAnglesPerRadian = 1e5f;  // FAP angles are 1e-5 rad.
constexpr float kNearRate = 3.4f;         // Camera: 95 % of its way in 1.4 s.
constexpr float kNeckRate = 12.0f;
constexpr float kUpright = 0.8f;  // What the neck takes back of the trunk's tilt, for a visitor.
constexpr float kAttentionRate = 5.0f;
constexpr float kEyesRate = 3.5f;
constexpr float kWalkingAttention = 0.55f;  // Who walks looks where she goes, too.
constexpr float kEyesYaw_rad = 0.42f, kEyesPitch_rad = 0.21f;  // Where eyes still look at ease.
constexpr float kStopping_m = 0.4f;  // How far a walk goes on that ends with the next step.
constexpr float kInside_m = 0.4f;    // From the edge of the picture to a person who is in it.

constexpr float kBearing = 0.5f;  // A felt emotion colours the bearing so much.

float wrapped(float rad) { return rad - 2.0f * kPi * std::floor(rad / (2.0f * kPi) + 0.5f); }

body::Walker walker_at(const body::Skeleton* skeleton, float x_m, float heading_rad,
                       std::uint64_t seed) {
  return body::Walker(skeleton, {x_m, 0.0f}, heading_rad, seed);
}

}  // namespace

float Follower::step(float target, float rate, float dt_s) {
  const float decay = exp_of(-rate * dt_s);
  const float offset = value - target;
  const float slope = velocity + rate * offset;
  value = target + (offset + slope * dt_s) * decay;
  velocity = (velocity - rate * slope * dt_s) * decay;
  return value;
}

Stage::Stage(const body::Skeleton* skeleton, const StageSetup& setup)
    : skeleton_(skeleton), setup_(setup), walker_(walker_at(skeleton, 0.0f, 0.0f, setup.seed)) {
  attention_.value = 1.0f;
  if (setup_.walks) {
    enter();
  } else {
    near_.value = 1.0f;
  }
  walker_.step(0.0f, body_);
  const Vec3 start = setup_.eyes_m + Vec3{walker_.place().x, 0.0f, walker_.place().y};
  for (int i = 0; i < 3; ++i) eyes_[i].value = start[i];
}

// Out of the picture: her arms swing half a metre wide.
float Stage::edge_m() const { return std::max(1.2f, setup_.half_width_m + 0.45f); }

void Stage::enter() {
  const float x = side_ * edge_m();
  walker_ =
      walker_at(skeleton_, x, side_ > 0.0f ? -0.5f * kPi : 0.5f * kPi, setup_.seed + ++entrances_);
  walker_.walk_to({0.0f, 0.0f}, 0.0f);
  phase_ = Phase::entering;
  clock_s_ = 0.0f;
  walking_off_ = called_ = false;
  attention_ = {.value = kWalkingAttention};
}

// The shortest way to the visitor: one more step, then turn.
void Stage::come_here() {
  const bool stands = phase_ == Phase::leaving && !walking_off_;
  const float inner = std::max(setup_.half_width_m - kInside_m, 0.1f);
  const float ahead = sin_of(walker_.heading_rad()) > 0.0f ? 1.0f : -1.0f;
  const float stops = walker_.place().x + ahead * kStopping_m;
  // On her way out she may stop at the very edge: to come back takes longer than the camera.
  const bool out = stops * ahead > 0.0f;
  if (std::abs(stops) > (out ? setup_.half_width_m : inner))
    walker_.walk_to({std::clamp(stops, -inner, inner), 0.0f}, 0.0f);
  else if (!stands)
    walker_.face(0.0f);
  phase_ = Phase::entering;
  called_ = true;
  walking_off_ = false;
}

void Stage::leave() {
  phase_ = Phase::leaving;
  walking_off_ = called_ = false;
}

void Stage::direct(float dt_s, const Intentions& will) {
  clock_s_ += dt_s;
  switch (phase_) {
    case Phase::away:
      if (will.pressed || (clock_s_ > kAway_s && !will.asleep)) enter();
      if (will.pressed) come_here();
      break;
    case Phase::entering:
      if (will.pressed && !called_) come_here();
      if (walker_.arrived()) phase_ = Phase::present;
      clock_s_ = 0.0f;
      break;
    case Phase::present:
      if (will.busy) clock_s_ = 0.0f;
      if (setup_.walks && (clock_s_ > setup_.sleep_s || (will.asleep && !will.busy))) leave();
      break;
    case Phase::leaving:
      if (will.pressed) {
        come_here();
      } else if (!walking_off_ && near_.value < 0.1f) {
        walking_off_ = true;
        walker_.walk_to({-side_ * edge_m(), 0.0f});
      } else if (walking_off_ && walker_.arrived()) {
        phase_ = Phase::away;
        side_ = -side_;
        clock_s_ = 0.0f;
      }
      break;
  }
}

void Stage::beat(float size) {
  if (phase_ != Phase::present || gestures_.active()) return;
  beat_left_ = !beat_left_;
  gestures_.start({.kind = body::GestureKind::beat, .left = beat_left_, .size = size});
}

// Small signs with the feelings that have one; the hands stay down, the camera is near.
void Stage::gesture(const Intentions& will) {
  const bool faces = std::abs(wrapped(walker_.heading_rad())) < 0.6f;
  const bool points = will.gesture == body::GestureKind::point;
  if (will.gesture != body::GestureKind::none && (faces || !points)) {
    Vec3 target = setup_.points_at_m;
    if (will.gesture_right) target.x = -target.x;
    gestures_.start({.kind = will.gesture,
                     .left = points && target.x > 0.0f,
                     .target_m = target + Vec3{walker_.place().x, 0.0f, walker_.place().y}});
  }
  if (will.emotion == gestured_) return;
  gestured_ = will.emotion;
  if (gestured_ == emotion::Emotion::joy)
    gestures_.start({.kind = body::GestureKind::nod, .size = 0.5f});
}

bool Stage::moving() const {
  return phase_ == Phase::entering || phase_ == Phase::leaving || std::abs(near_.velocity) > 0.01f;
}

// The framed height goes from the body's 1.94 m to the head's 0.36 m. Equal steps of near_ shall be
// equal ratios of size, so the share follows an exponential: (1 - r^s) / (1 - r), r = 0.19.
float Stage::closeness() const {
  constexpr float kRatio = 0.19f, kLogRatio = -1.6607f;
  return std::clamp((1.0f - exp_of(kLogRatio * near_.value)) / (1.0f - kRatio), 0.0f, 1.0f);
}

void Stage::step(float dt_s, const Intentions& will, Vec3 camera_m) {
  const float dt = dt_s > 0.0f ? std::min(dt_s, 0.1f) : 0.0f;
  direct(dt, will);
  gesture(will);
  const emotion::Place mood = emotion::place_of(will.emotions);
  walker_.set_style(body::gait_style_at(kBearing * mood.activation, kBearing * mood.evaluation));
  walker_.step(dt, body_);
  for (int bap = 1; bap <= body::kBapCount; ++bap)
    if (will.body.has(bap)) body_.set(bap, body_.get(bap) + will.body.get(bap));
  // The camera comes when she has all but turned to the visitor.
  const bool here = phase_ == Phase::present ||
                    (phase_ == Phase::entering && std::abs(wrapped(walker_.heading_rad())) < 0.5f);
  near_.step(here ? 1.0f : 0.0f, kNearRate, dt);
  face_ = will.idle_face;
  turn_neck(dt, camera_m);
  gestures_.step(dt);
  gestures_.apply(*skeleton_, body_);
  aim_eyes(dt, camera_m);
}

// The head turns to the visitor before and faster than the body does.
void Stage::turn_neck(float dt_s, Vec3 camera_m) {
  const bool walks = walker_.vigour() > 0.3f && !called_;
  const float wanted = walking_off_ || phase_ == Phase::away ? 0.0f
                       : walks                               ? kWalkingAttention
                                                             : 1.0f;
  const float attention = attention_.step(wanted, kAttentionRate, dt_s);
  const Vec2 way = Vec2{camera_m.x, camera_m.z} - walker_.place();
  const float aside = wrapped(atan2_of(way.x, way.y) - walker_.heading_rad());
  const float target = attention * std::clamp(aside, -kNeckTurn_rad, kNeckTurn_rad);
  const float turn = neck_.step(target, kNeckRate, dt_s);
  add_neck(body::Axis::y, turn);
  // A bearing that throws the chest out or bows the back leaves the face to the visitor.
  float tilt = 0.0f;
  for (std::size_t j = body::index_of(HanimJoint::vl5); j <= body::index_of(HanimJoint::skullbase);
       ++j)
    tilt += body::get_turn(body_, static_cast<HanimJoint>(j), body::Axis::x);
  add_neck(body::Axis::x, -kUpright * attention * tilt);
}

// Shares a turn among the joints of the neck.
void Stage::add_neck(body::Axis axis, float rad) {
  constexpr std::size_t kFirst = body::index_of(HanimJoint::vc7);
  constexpr std::size_t kCount = body::index_of(HanimJoint::skullbase) - kFirst + 1;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto joint = static_cast<HanimJoint>(kFirst + i);
    const float own = body::get_turn(body_, joint, axis);
    body::set_turn(body_, joint, axis, own + rad / static_cast<float>(kCount));
  }
}

// The eyes take what the head leaves, with its bobbing in the walk (vestibulo-ocular reflex).
void Stage::aim_eyes(float dt_s, Vec3 camera_m) {
  std::array<Affine, body::kHanimJointCount> pose;
  if (!body::PoseJob{.skeleton = skeleton_, .baps = &body_, .out = pose}.run().ok()) return;
  const Affine& skull = pose[body::index_of(HanimJoint::skullbase)];
  const Vec3 eyes = skull.point(setup_.eyes_m);
  for (int i = 0; i < 3; ++i) eyes_[i].step(eyes[i], kEyesRate, dt_s);
  const Vec3 way = camera_m - eyes;
  const float left = glm::dot(way, skull.direction({1, 0, 0}));
  const float up = glm::dot(way, skull.direction({0, 1, 0}));
  const float ahead = glm::dot(way, skull.direction({0, 0, 1}));
  const float share = std::clamp(attention_.value, 0.0f, 1.0f);
  const float yaw = share * std::clamp(atan2_of(left, ahead), -kEyesYaw_rad, kEyesYaw_rad);
  const float level = std::sqrt(left * left + ahead * ahead);
  const float down = share * std::clamp(-atan2_of(up, level), -kEyesPitch_rad, kEyesPitch_rad);
  for (const int fap : {23, 24}) face_.set(fap, face_.get(fap) + yaw * kAnglesPerRadian);
  for (const int fap : {25, 26}) face_.set(fap, face_.get(fap) + down * kAnglesPerRadian);
}

}  // namespace caryatid::agent
