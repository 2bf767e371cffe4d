#include <cmath>

#include "core/base/fixed.h"
#include "core/body/hanim.h"

namespace caryatid::body {
namespace {

constexpr auto kNone = HanimJoint::count;

bool below(HanimJoint joint, HanimJoint ancestor) {
  for (HanimJoint j = joint; j != kNone; j = hanim_parent(j))
    if (j == ancestor) return true;
  return false;
}

bool is_leg(HanimJoint joint) {
  return below(joint, HanimJoint::l_hip) || below(joint, HanimJoint::r_hip);
}

// Rotation and scale that carry `from` to `to` by the shortest way, applied to p.
Vec3 carried(Vec3 p, Vec3 from, Vec3 to) {
  const float from_m = std::sqrt(glm::dot(from, from));
  const float to_m = std::sqrt(glm::dot(to, to));
  if (from_m < 1e-6f) return p;
  const float scale = to_m / from_m;
  if (to_m < 1e-6f) return p * scale;
  const Vec3 u = from / from_m;
  const Vec3 v = to / to_m;
  const float cosine = glm::dot(u, v);
  if (cosine < -0.999f) return p * scale;
  const Vec3 axis = glm::cross(u, v);  // Rodrigues with sin = |axis|.
  return (p * cosine + glm::cross(axis, p) + axis * (glm::dot(axis, p) / (1.0f + cosine))) * scale;
}

using JointSet = BitSet<kHanimJointCount>;

HanimJoint given_ancestor(HanimJoint joint, const JointSet& given) {
  for (HanimJoint j = hanim_parent(joint); j != kNone; j = hanim_parent(j))
    if (given.test(index_of(j))) return j;
  return kNone;
}

// The nearest given joint below `joint`: the first, as children stand after parents.
HanimJoint given_descendant(HanimJoint joint, const JointSet& given) {
  for (std::size_t d = index_of(joint) + 1; d < kHanimJointCount; ++d)
    if (given.test(d) && below(static_cast<HanimJoint>(d), joint))
      return static_cast<HanimJoint>(d);
  return kNone;
}

Status take_given(std::span<const JointCenter> given, JointSet& known, Skeleton& body) {
  for (const JointCenter& g : given) {
    if (g.joint >= kNone || known.test(index_of(g.joint))) return {Code::invalid_argument, 1};
    if (!std::isfinite(g.center_m.x) || !std::isfinite(g.center_m.y) ||
        !std::isfinite(g.center_m.z))
      return {Code::invalid_argument, 2};
    known.set(index_of(g.joint));
    body.center_m[index_of(g.joint)] = g.center_m;
  }
  return {};
}

float height_ratio(const Skeleton& generic, std::span<const JointCenter> given) {
  float sent = 0.0f, own = 0.0f;
  for (const JointCenter& g : given) {
    sent += g.center_m.y;
    own += generic.center(g.joint).y;
  }
  return given.empty() || own < 1e-3f ? 1.0f : sent / own;
}

}  // namespace

Skeleton default_skeleton() {
  Skeleton body;
  for (std::size_t j = 0; j < kHanimJointCount; ++j)
    body.center_m[j] = hanim_info(static_cast<HanimJoint>(j)).center_m;
  derive_soles(body);
  return body;
}

Skeleton upright_skeleton() {
  constexpr float kThigh = 0.427f, kShank = 0.434f, kAnkle = 0.066f;  // Lengths of the same figure.
  constexpr float kMetatarsalHeight = 0.02f;  // The published centre lies on the floor itself.
  Skeleton body = default_skeleton();
  const Vec3 old_hip = body.center(HanimJoint::l_hip);
  const Vec3 old_ankle = body.center(HanimJoint::l_ankle);
  const float raised = kAnkle + kShank + kThigh - old_hip.y;
  const float forward = old_hip.z - old_ankle.z;
  for (std::size_t j = 0; j < kHanimJointCount; ++j) {
    Vec3& c = body.center_m[j];
    if (!is_leg(static_cast<HanimJoint>(j)))
      c.y += raised;
    else if (c.y < 0.2f)
      c.z += forward;
  }
  for (const bool left : {true, false}) {
    const auto at = [&](HanimJoint l) -> Vec3& {
      return body.center_m[index_of(left ? l : mirrored(l))];
    };
    at(HanimJoint::l_hip).y = kAnkle + kShank + kThigh;
    at(HanimJoint::l_knee).y = kAnkle + kShank;
    at(HanimJoint::l_knee).z = old_hip.z;
    at(HanimJoint::l_ankle).y = kAnkle;
    at(HanimJoint::l_metatarsal).y = kMetatarsalHeight;
  }
  derive_soles(body);
  return body;
}

void derive_soles(Skeleton& skeleton) {
  // Sites of the default figure, from its ankle: heel 0.0435 m behind, toe tip 0.0714 m before the
  // metatarsal, that 0.1498 m before the ankle. The roundings are of a soft shoe.
  for (std::size_t side = 0; side < 2; ++side) {
    const Vec3 ankle = skeleton.center(side == 0 ? HanimJoint::l_ankle : HanimJoint::r_ankle);
    const Vec3 ball =
        skeleton.center(side == 0 ? HanimJoint::l_metatarsal : HanimJoint::r_metatarsal);
    const float s = (ball.z - ankle.z) / 0.1498f;
    skeleton.sole[side] = {.heel_back = {ankle.z - 0.0435f * s, 0.012f * s},
                           .heel = {ankle.z - 0.034f * s, 0.0f},
                           .ball = {ball.z, 0.0f},
                           .toe = {ball.z + 0.060f * s, 0.0f},
                           .toe_tip = {ball.z + 0.0714f * s, 0.012f * s}};
  }
}

namespace {

// Slopes at which lines are laid against a sole from below: a little and far tipped onto the heel,
// a little and far onto the toes. A heel strikes at up to 22 degrees, toes leave at up to 37.
constexpr std::array<float, 4> kTangents = {0.10f, 0.40f, -0.22f, -0.75f};

}  // namespace

void SoleFitter::add(Vec3 p) {
  constexpr float kNear_m = 0.06f;
  if (!(p.y < kNear_m) || !(p.y > -kNear_m)) return;
  Side& side = side_[p.x > 0.0f ? 0 : 1];
  ++side.count;
  for (std::size_t i = 0; i < kTangents.size(); ++i) {
    const float height = p.y + kTangents[i] * p.z;
    if (height < side.height_m[i]) side.height_m[i] = height;
  }
}

void SoleFitter::finish(Skeleton& skeleton) const {
  for (std::size_t i = 0; i < 2; ++i) {
    const Side& side = side_[i];
    if (side.count < 12) continue;
    // Corners of the outline that floor and tangents make: nothing of the foot is outside.
    const auto corners = [&](std::size_t first, Vec2& stands, Vec2& raised) {
      const float s1 = kTangents[first], s2 = kTangents[first + 1];
      const float h1 = side.height_m[first], h2 = side.height_m[first + 1];
      stands = {h1 / s1, 0.0f};
      const float z = (h1 - h2) / (s1 - s2);
      raised = {z, h1 - s1 * z > 0.0f ? h1 - s1 * z : 0.0f};
    };
    Sole& sole = skeleton.sole[i];
    corners(0, sole.heel, sole.heel_back);
    corners(2, sole.toe, sole.toe_tip);
    sole.ball = sole.toe;  // Of this shape the floor knows no other.
  }
}

Status calibrate(const Skeleton& generic, std::span<const JointCenter> given, Skeleton& out,
                 CalibrationReport& report) {
  Skeleton body = generic;
  JointSet known;
  CARYATID_TRY(take_given(given, known, body));
  CalibrationReport facts{.given = static_cast<std::uint16_t>(given.size())};
  const float ratio = height_ratio(generic, given);
  const float stature = ratio * generic.center(HanimJoint::skullbase).y;
  if (!(stature > 0.9f && stature < 2.3f)) return {Code::invalid_argument, 3};
  for (std::size_t j = 0; j < kHanimJointCount; ++j) {
    const auto joint = static_cast<HanimJoint>(j);
    const HanimJoint above = given_ancestor(joint, known);
    if (known.test(j)) {
      if (above == kNone) continue;
      const Vec3 old_bone = generic.center_m[j] - generic.center(above);
      const Vec3 new_bone = body.center_m[j] - body.center(above);
      const float old_m = std::sqrt(glm::dot(old_bone, old_bone));
      if (old_m < 0.02f) continue;  // Too short for its direction to mean anything.
      const float scale = std::sqrt(glm::dot(new_bone, new_bone)) / old_m;
      if (!(scale >= 0.3f && scale <= 3.0f)) return {Code::invalid_argument, 4};
      facts.smallest_scale = scale < facts.smallest_scale ? scale : facts.smallest_scale;
      facts.largest_scale = scale > facts.largest_scale ? scale : facts.largest_scale;
      continue;
    }
    ++facts.derived;
    if (above == kNone) {
      body.center_m[j] = generic.center_m[j] * ratio;
      continue;
    }
    const Vec3 offset = generic.center_m[j] - generic.center(above);
    const HanimJoint next = given_descendant(joint, known);
    body.center_m[j] =
        body.center(above) + (next == kNone
                                  ? offset * ratio
                                  : carried(offset, generic.center(next) - generic.center(above),
                                            body.center(next) - body.center(above)));
  }
  derive_soles(body);
  out = body;
  report = facts;
  return {};
}

}  // namespace caryatid::body
