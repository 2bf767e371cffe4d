#include "assets/bake/gait/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/body/pose.h"

namespace caryatid::bake {
namespace {

using body::HanimJoint;
constexpr float kDegrees = 57.2957795f;
constexpr float kStandsBelow = 0.002f;

std::vector<Affine> posed(const body::Skeleton& s, const body::BapFrame& f) {
  std::vector<Affine> pose(body::kHanimJointCount);
  (void)body::PoseJob{.skeleton = &s, .baps = &f, .out = pose}.run();
  return pose;
}

Vec3 moved(const SolePoint& p, std::span<const Affine> pose) {
  Vec3 out(0.0f);
  for (const SolePoint::Share& s : p.shares)
    out += s.weight * pose[index_of(s.joint)].point(p.rest_m);
  return out;
}

constexpr float kLifted_m = 0.003f;
using Heights = std::array<std::vector<float>, 2>;  // Lowest point of each foot, frame by frame.

void find_steps(const Heights& low, WalkMeasures& m) {
  for (const std::vector<float>& l : low)
    for (std::size_t i = 1, begin = 0; i < l.size(); ++i) {
      if (l[i] > kLifted_m && l[i - 1] <= kLifted_m) begin = i;
      if (l[i] <= kLifted_m && l[i - 1] > kLifted_m && begin > 0) {
        ++m.steps;
        const std::size_t span = i - begin;
        for (std::size_t k = begin + span * 3 / 10; k < begin + span * 7 / 10; ++k)
          m.clearance_m = std::min(m.clearance_m, l[k]);
      }
    }
}

std::vector<std::size_t> landings_of(const Heights& low) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 1; i < low[0].size(); ++i)
    for (const std::vector<float>& l : low)
      if (l[i] <= kLifted_m && l[i - 1] > kLifted_m) frames.push_back(i);
  return frames;
}

void count_maxima(const std::vector<float>& height, const std::vector<std::size_t>& landings,
                  WalkMeasures& m) {
  for (std::size_t step = 1; step < landings.size(); ++step) {
    int maxima = 0;
    for (std::size_t i = landings[step - 1]; i < landings[step]; ++i)
      if (i > 0 && height[i] > height[i - 1] && height[i] >= height[i + 1]) ++maxima;
    m.fewest_maxima = step == 1 ? maxima : std::min(m.fewest_maxima, maxima);
    m.most_maxima = std::max(m.most_maxima, maxima);
  }
}

}  // namespace

std::vector<SolePoint> outline_points(const body::Skeleton& skeleton) {
  std::vector<SolePoint> points;
  for (const bool left : {true, false}) {
    const body::Sole& sole = skeleton.sole[left ? 0 : 1];
    const HanimJoint hind = left ? HanimJoint::l_midtarsal : HanimJoint::r_midtarsal;
    const HanimJoint toes = left ? HanimJoint::l_metatarsal : HanimJoint::r_metatarsal;
    const float x = skeleton.center(left ? HanimJoint::l_ankle : HanimJoint::r_ankle).x;
    const auto add = [&](Vec2 zy, HanimJoint j) {
      points.push_back({{x, zy.y, zy.x}, left, {{j, 1.0f}}});
    };
    add(sole.heel_back, hind);
    add(sole.heel, hind);
    add(sole.ball, toes);
    add(sole.toe, toes);
    add(sole.toe_tip, toes);
  }
  return points;
}

WalkMeasures measure_walk(const body::Skeleton& skeleton, std::span<const body::BapFrame> frames,
                          float fps, std::span<const SolePoint> soles) {
  WalkMeasures m;
  std::vector<Vec3> before, now(soles.size());
  std::vector<float> pelvis;
  std::array<std::vector<float>, 2> low;
  Vec3 first_root(0.0f), root(0.0f);
  for (const body::BapFrame& frame : frames) {
    const std::vector<Affine> pose = posed(skeleton, frame);
    root = joint_position(skeleton, pose, HanimJoint::humanoid_root);
    if (pelvis.empty()) first_root = root;
    pelvis.push_back(root.y);
    std::array<float, 2> lowest = {1e9f, 1e9f};
    for (std::size_t i = 0; i < soles.size(); ++i) {
      now[i] = moved(soles[i], pose);
      float& l = lowest[soles[i].left ? 0 : 1];
      l = std::min(l, now[i].y);
    }
    for (std::size_t i = 0; i < soles.size() && !before.empty(); ++i) {
      // Standing: on the floor now and before, and not merely passing through that height.
      if (now[i].y > kStandsBelow || before[i].y > kStandsBelow) continue;
      m.slide_m = std::max(m.slide_m, std::hypot(now[i].x - before[i].x, now[i].z - before[i].z));
    }
    for (std::size_t side = 0; side < 2; ++side) {
      m.below_floor_m = std::max(m.below_floor_m, -lowest[side]);
      low[side].push_back(lowest[side]);
    }
    before = now;
  }
  const auto [least, most] = std::minmax_element(pelvis.begin(), pelvis.end());
  m.pelvis_travel_m = *most - *least;
  find_steps(low, m);
  count_maxima(pelvis, landings_of(low), m);
  const float seconds = static_cast<float>(frames.size() - 1) / fps;
  m.speed_mps = std::hypot(root.x - first_root.x, root.z - first_root.z) / seconds;
  m.step_m = m.steps == 0 ? 0.0f : m.speed_mps * seconds / static_cast<float>(m.steps);
  return m;
}

PelvisTurn pelvis_turn(Vec3 hip, Vec3 other_hip, Vec3 ahead) {
  const Vec3 way = hip - other_hip;
  const float out = std::abs(glm::dot(way, glm::cross(Vec3{0, 1, 0}, ahead)));
  return {std::atan2(way.y, out) * kDegrees, std::atan2(glm::dot(way, ahead), out) * kDegrees};
}

LegAngles leg_angles(const body::Skeleton& s, const body::BapFrame& frame, bool left) {
  const std::vector<Affine> pose = posed(s, frame);
  const auto side = [&](HanimJoint l) { return left ? l : body::mirrored(l); };
  const auto at = [&](HanimJoint l) { return joint_position(s, pose, side(l)); };
  const Vec3 ahead = pose[0].direction({0, 0, 1});
  const auto forward = [&](Vec3 v) { return std::atan2(glm::dot(v, ahead), -v.y); };
  const Vec3 thigh = at(HanimJoint::l_knee) - at(HanimJoint::l_hip);
  const Vec3 shank = at(HanimJoint::l_ankle) - at(HanimJoint::l_knee);
  const Vec3 toe = pose[index_of(side(HanimJoint::l_midtarsal))].direction({0, 0, 1});
  LegAngles a;
  a.thigh = forward(thigh) * kDegrees;
  a.knee = a.thigh - forward(shank) * kDegrees;
  a.foot_pitch = std::atan2(toe.y, glm::dot(toe, ahead)) * kDegrees;
  a.ankle = a.foot_pitch - a.thigh + a.knee;
  const Vec3 other = joint_position(s, pose, body::mirrored(side(HanimJoint::l_hip)));
  const PelvisTurn pelvis = pelvis_turn(at(HanimJoint::l_hip), other, pose[0].direction({0, 0, 1}));
  a.list = pelvis.list;
  a.rotation = pelvis.rotation;
  return a;
}

}  // namespace caryatid::bake
