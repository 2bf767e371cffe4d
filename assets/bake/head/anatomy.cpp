#include "assets/bake/head/anatomy.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/body/hanim.h"

namespace caryatid::bake::foreign {
namespace {

using body::HanimJoint;

float smooth(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// The skin vertex of the face that is nearest to a place seen from the front, the foremost first.
std::uint32_t nearest_in_front(const PlacedHead& head, const Openings& openings, Vec3 place_m) {
  std::uint32_t best = 0;
  float least = 1e9f;
  for (std::uint32_t v = 0; v < head.position_m.size(); ++v) {
    if (openings.zone[v] != Zone::face) continue;
    const Vec3 d = head.position_m[v] - place_m;
    const float cost = d.x * d.x + d.y * d.y + 0.25f * d.z * d.z;
    if (cost < least) least = cost, best = v;
  }
  return best;
}

}  // namespace

std::uint16_t joint_index(const std::vector<Joint>& joints, HanimJoint joint) {
  for (std::uint16_t j = 0; j < joints.size(); ++j)
    if (joints[j].hanim == body::index_of(joint)) return j;
  throw std::logic_error("a joint of the head is missing");
}

// Ratios: the mean of our two characters, whose skeleton is that of the base human. z is counted
// back from the lids.
std::vector<Joint> head_joints(const PlacedHead& head, const Openings& openings) {
  const float es = head.eye_separation_m, tall = head.eyes_to_chin_m();
  const Vec3 lids = head.lids_m();
  const auto at = [&](float down_m, float back) {
    return Vec3(lids.x, lids.y - down_m, lids.z - back * es);
  };
  const Vec3 skull = at(0.32f * tall, 1.60f), axis = at(1.05f * es, 1.80f),
             foot = at(2.35f * es, 2.22f);
  Vec3 hinge = at(0.29f * tall, 1.33f);
  if (head.vertex.contains({10, 7}) && head.vertex.contains({10, 8})) {  // In front of the lobes.
    const float lobes = 0.5f * (head.at(10, 7).z + head.at(10, 8).z) + 0.43f * es;
    hinge.z = std::min(lobes, lids.z - 1.1f * es);  // A flat mask's ears tell nothing.
  }
  std::vector<Joint> joints;
  const auto add = [&](HanimJoint joint, HanimJoint parent, Vec3 center) {
    joints.push_back({static_cast<std::uint16_t>(body::index_of(joint)),
                      parent == HanimJoint::count ? pack::kNoJoint : joint_index(joints, parent),
                      center});
  };
  add(HanimJoint::vc7, HanimJoint::count, foot);
  constexpr HanimJoint kNeck[] = {HanimJoint::vc7, HanimJoint::vc6, HanimJoint::vc5,
                                  HanimJoint::vc4, HanimJoint::vc3, HanimJoint::vc2};
  for (std::size_t i = 1; i < std::size(kNeck); ++i)
    add(kNeck[i], kNeck[i - 1], glm::mix(foot, axis, static_cast<float>(i) / 5.0f));
  add(HanimJoint::vc1, HanimJoint::vc2, glm::mix(axis, skull, 0.6f));
  add(HanimJoint::skullbase, HanimJoint::vc1, skull);
  add(HanimJoint::l_eyeball_joint, HanimJoint::skullbase, openings.eye[0].center_m);
  add(HanimJoint::r_eyeball_joint, HanimJoint::skullbase, openings.eye[1].center_m);
  add(HanimJoint::temporomandibular, HanimJoint::skullbase, hinge);
  return joints;
}

Influence neck_influence(const std::vector<Joint>& joints, Vec3 p) {
  const std::uint16_t chain[] = {
      joint_index(joints, HanimJoint::skullbase), joint_index(joints, HanimJoint::vc2),
      joint_index(joints, HanimJoint::vc5), joint_index(joints, HanimJoint::vc7)};
  // A face in front of the neck goes with the skull down to the chin's own underside: the border
  // between skull and neck falls towards the front.
  const Vec3 skull = joints[chain[0]].center_m;
  const float slope = 0.75f;
  const float y = p.y + slope * std::max(p.z - skull.z, 0.0f);
  Influence out;
  out.weight = {0, 0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) out.joint[i] = chain[i];
  float left = 1.0f;
  for (std::size_t i = 0; i < 3; ++i) {
    const float top = joints[chain[i]].center_m.y, low = joints[chain[i + 1]].center_m.y;
    const float stays = smooth(low, top, y);
    out.weight[i] = left * stays;
    left *= 1.0f - stays;
  }
  out.weight[3] = left;
  return out;
}

std::vector<float> mandible_share(const PlacedHead& head, Vec3 hinge) {
  const auto angle = [&](Vec3 p) { return std::atan2(hinge.y - p.y, p.z - hinge.z); };
  const auto arm = [&](Vec3 p) { return std::hypot(p.y - hinge.y, p.z - hinge.z); };
  const Vec3 corner = 0.5f * (head.at(2, 4) + head.at(2, 5)), chin = head.at(2, 1);
  const float from = angle(corner), span = std::max(angle(chin) - from, 0.05f);
  std::vector<float> share;
  for (const Vec3& p : head.position_m) {
    const float t = (angle(p) - from) / span, r = arm(p) / arm(chin);
    share.push_back(smooth(-0.05f, 0.75f, t) * smooth(1.9f, 1.15f, t) * smooth(0.12f, 0.55f, r));
  }
  return share;
}

void derive_points(const Openings& openings, PlacedHead& head) {
  const float es = head.eye_separation_m, tall = head.eyes_to_chin_m();
  const Vec3 lids = head.lids_m();
  const auto add = [&](int group, int index, Vec3 near) {
    if (!head.vertex.contains({group, index}))
      head.vertex[{group, index}] = nearest_in_front(head, openings, near);
  };
  const Vec3 lip = head.at(8, 2), chin = head.at(2, 1);
  add(2, 10, glm::mix(lip, chin, 0.56f) + Vec3(0, 0, 0.1f * es));
  for (int side = 0; side < fat::kSides; ++side) {
    const float x = fat::outward(side);
    add(5, 1 + side, lids + Vec3(0.70f * es * x, -0.667f * tall, -0.2f * es));
    add(5, 3 + side, lids + Vec3(0.735f * es * x, -0.26f * tall, -0.1f * es));
    head.place_m[{3, 5 + side}] = openings.eye[static_cast<std::size_t>(side)].center_m;
  }
  for (const auto& [id, v] : head.vertex) head.place_m[id] = head.position_m[v];
}

}  // namespace caryatid::bake::foreign
