#include "assets/bake/human/skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace caryatid::bake {
namespace {

using body::HanimJoint;
using body::HelperJoint;

std::uint16_t number(HanimJoint joint) { return static_cast<std::uint16_t>(joint); }
// The joint of the other side follows its left twin in the enumeration.
HanimJoint sided(HanimJoint left, bool right) {
  return static_cast<HanimJoint>(static_cast<int>(left) + (right ? 1 : 0));
}

struct Pair {
  const char* bone;  // Without ".L"
  HanimJoint left;
};
// Joints that lie at the head of a bone and take over its skin.
constexpr Pair kLimbs[] = {
    {"upperleg01", HanimJoint::l_hip},
    {"lowerleg01", HanimJoint::l_knee},
    {"foot", HanimJoint::l_ankle},
    {"toe2-1", HanimJoint::l_metatarsal},
    {"clavicle", HanimJoint::l_sternoclavicular},
    {"shoulder01", HanimJoint::l_acromioclavicular},
    {"upperarm01", HanimJoint::l_shoulder},
    {"lowerarm01", HanimJoint::l_elbow},
    {"wrist", HanimJoint::l_wrist},
    {"finger1-1", HanimJoint::l_thumb1},
    {"finger1-2", HanimJoint::l_thumb2},
    {"finger1-3", HanimJoint::l_thumb3},
    {"metacarpal1", HanimJoint::l_index0},
    {"finger2-1", HanimJoint::l_index1},
    {"finger2-2", HanimJoint::l_index2},
    {"finger2-3", HanimJoint::l_index3},
    {"metacarpal2", HanimJoint::l_middle0},
    {"finger3-1", HanimJoint::l_middle1},
    {"finger3-2", HanimJoint::l_middle2},
    {"finger3-3", HanimJoint::l_middle3},
    {"metacarpal3", HanimJoint::l_ring0},
    {"finger4-1", HanimJoint::l_ring1},
    {"finger4-2", HanimJoint::l_ring2},
    {"finger4-3", HanimJoint::l_ring3},
    {"metacarpal4", HanimJoint::l_pinky0},
    {"finger5-1", HanimJoint::l_pinky1},
    {"finger5-2", HanimJoint::l_pinky2},
    {"finger5-3", HanimJoint::l_pinky3},
};
// Bones that only share the skin of a joint above.
constexpr Pair kFollowers[] = {
    {"upperleg02", HanimJoint::l_hip},      {"lowerleg02", HanimJoint::l_knee},
    {"upperarm02", HanimJoint::l_shoulder}, {"lowerarm02", HanimJoint::l_elbow},
    {"eye", HanimJoint::l_eyeball_joint},
};
// The vertebrae that carry skin.
constexpr HanimJoint kCarriers[] = {HanimJoint::vl5,  HanimJoint::vl3, HanimJoint::vl1,
                                    HanimJoint::vt11, HanimJoint::vt9, HanimJoint::vt6,
                                    HanimJoint::vt3,  HanimJoint::vt1, HanimJoint::vc6,
                                    HanimJoint::vc4,  HanimJoint::vc2};

// A point at share `t` (0..1) of the length of a line.
Vec3 along(std::span<const Vec3> line, float t) {
  float total = 0;
  for (std::size_t i = 1; i < line.size(); ++i) total += glm::distance(line[i - 1], line[i]);
  float left = t * total;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const float step = glm::distance(line[i - 1], line[i]);
    if (left <= step || i + 1 == line.size())
      return glm::mix(line[i - 1], line[i], step > 0 ? left / step : 0.0f);
    left -= step;
  }
  return line.back();
}

// Vertebrae `first`..`last` along the line, spaced as in the default figure.
void lay_vertebrae(std::vector<Joint>& joints, HanimJoint first, HanimJoint last, HanimJoint beyond,
                   std::span<const Vec3> line) {
  const float from = body::hanim_info(first).center_m.y;
  const float to = body::hanim_info(beyond).center_m.y;
  for (int j = static_cast<int>(first); j <= static_cast<int>(last); ++j) {
    const auto joint = static_cast<HanimJoint>(j);
    const float t = (body::hanim_info(joint).center_m.y - from) / (to - from);
    joints[body::index_of(joint)].center_m = along(line, t);
  }
}

}  // namespace

std::vector<Joint> hanim_joints(const BaseHuman& base, std::span<const Vec3> bone_head_m,
                                std::span<const Vec3, 2> eye_center_m) {
  std::vector<Joint> joints(body::kHanimJointCount);
  const auto head = [&](const std::string& bone) { return bone_head_m[base.bone(bone)]; };
  const auto center = [&](HanimJoint joint) -> Vec3& {
    return joints[body::index_of(joint)].center_m;
  };
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const HanimJoint parent = body::hanim_parent(static_cast<HanimJoint>(i));
    joints[i].hanim = static_cast<std::uint16_t>(i);
    joints[i].parent = parent == HanimJoint::count ? pack::kNoJoint : number(parent);
  }
  for (const bool right : {false, true}) {
    const std::string s = right ? ".R" : ".L";
    for (const Pair& pair : kLimbs) center(sided(pair.left, right)) = head(pair.bone + s);
    // Toes bend in the sole: the base's bone lies in the flesh above, and H-Anim's own figure has
    // the joint on the floor. The higher it lies, the more a bending sole slides.
    constexpr float kSoleHinge_m = 0.012f;
    float& hinge = center(sided(HanimJoint::l_metatarsal, right)).y;
    hinge = std::min(hinge, kSoleHinge_m);
    // Of the foot's inner joints the base has none: beneath the ankle, and half way to the toes.
    const Vec3 ankle = center(sided(HanimJoint::l_ankle, right));
    const Vec3 toes = center(sided(HanimJoint::l_metatarsal, right));
    center(sided(HanimJoint::l_subtalar, right)) = {ankle.x, 0.5f * (ankle.y + toes.y), ankle.z};
    center(sided(HanimJoint::l_midtarsal, right)) = glm::mix(ankle, toes, 0.5f);
    const Vec3 eye = eye_center_m[right ? 1 : 0];
    center(sided(HanimJoint::l_eyeball_joint, right)) = eye;
    center(sided(HanimJoint::l_eyelid_joint, right)) = eye;
    center(sided(HanimJoint::l_eyebrow_joint, right)) = head("oculi01" + s);
  }
  const Vec3 hips = 0.5f * (center(HanimJoint::l_hip) + center(HanimJoint::r_hip));
  center(HanimJoint::humanoid_root) = hips;
  center(HanimJoint::sacroiliac) = glm::mix(hips, head("spine05"), 0.5f);
  const Vec3 trunk[] = {head("spine05"), head("spine04"), head("spine03"),
                        head("spine02"), head("spine01"), head("neck01")};
  lay_vertebrae(joints, HanimJoint::vl5, HanimJoint::vt1, HanimJoint::vc7, trunk);
  const Vec3 neck[] = {head("neck01"), head("neck02"), head("neck03"), head("head")};
  lay_vertebrae(joints, HanimJoint::vc7, HanimJoint::vc1, HanimJoint::skullbase, neck);
  center(HanimJoint::skullbase) = head("head");
  center(HanimJoint::temporomandibular) = head("jaw");
  for (std::size_t h = 0; h < body::kHelperJointCount; ++h) {
    const HanimJoint owner = body::helper_owner(static_cast<HelperJoint>(h));
    joints.push_back(
        {static_cast<std::uint16_t>(body::kHanimJointCount + h), number(owner), center(owner)});
  }
  return joints;
}

WeightMap::WeightMap(const BaseHuman& base, std::span<const Joint> joints) : joints_(joints) {
  for (const Bone& bone : base.bones()) rules_.push_back(rule_of(bone.name));
  // A joint alone carries the skin half way up to the next carrier.
  std::vector<std::uint16_t> chain{number(HanimJoint::sacroiliac)};
  for (const HanimJoint joint : kCarriers) chain.push_back(number(joint));
  chain.push_back(number(HanimJoint::skullbase));
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const float here = joints[chain[i]].center_m.y;
    const float next = i + 1 < chain.size() ? joints[chain[i + 1]].center_m.y : here + 0.02f;
    levels_.push_back({chain[i], 0.5f * (here + next)});
  }
}

WeightMap::Rule WeightMap::rule_of(const std::string& bone) const {
  const bool right = bone.ends_with(".R");
  const std::string stem = right || bone.ends_with(".L") ? bone.substr(0, bone.size() - 2) : bone;
  if (stem.starts_with("spine") || stem.starts_with("neck") || stem == "breast")
    return {Kind::trunk, 0};
  if (stem == "root" || stem == "pelvis") return {Kind::joint, number(HanimJoint::sacroiliac)};
  if (stem == "foot") return {Kind::foot, number(sided(HanimJoint::l_subtalar, right))};
  if (stem.starts_with("toe")) return {Kind::joint, number(sided(HanimJoint::l_metatarsal, right))};
  for (const Pair& pair : kLimbs)
    if (stem == pair.bone) return {Kind::joint, number(sided(pair.left, right))};
  for (const Pair& pair : kFollowers)
    if (stem == pair.bone) return {Kind::joint, number(sided(pair.left, right))};
  return {Kind::joint, number(HanimJoint::skullbase)};  // The face moves by the FAT.
}

// How far along the limb a point lies, 0..1.
float WeightMap::share_along(HanimJoint from, HanimJoint to, Vec3 p) const {
  const Vec3 a = joints_[number(from)].center_m, d = joints_[number(to)].center_m - a;
  return std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0f, 1.0f);
}

// Twists wind up along the arm, and elbow and knee bend in two halves.
void WeightMap::spread_over_helpers(Shares& sum, Vec3 p, bool right) const {
  const auto helper = [&](HelperJoint left) {
    return static_cast<std::uint16_t>(body::index_of(left) + (right ? 1 : 0));
  };
  const auto take = [&](std::uint16_t joint) {
    const auto found = sum.find(joint);
    if (found == sum.end()) return 0.0f;
    const float w = found->second;
    sum.erase(found);
    return w;
  };
  const auto give = [&](std::uint16_t joint, float w) {
    if (w > 0) sum[joint] += w;
  };
  // Of what two neighbours share, the half joint gets what keeps the mean of the bend.
  const auto hinge = [&](float& above, float& below, std::uint16_t half) {
    const float middle = 2.0f * std::min(above, below);
    above -= 0.5f * middle;
    below -= 0.5f * middle;
    give(half, middle);
  };
  const HanimJoint shoulder = sided(HanimJoint::l_shoulder, right);
  const HanimJoint elbow = sided(HanimJoint::l_elbow, right);
  const HanimJoint wrist = sided(HanimJoint::l_wrist, right);
  const HanimJoint hip = sided(HanimJoint::l_hip, right);
  const HanimJoint knee = sided(HanimJoint::l_knee, right);
  float upper = take(number(shoulder)), fore = take(number(elbow));
  hinge(upper, fore, helper(HelperJoint::l_elbow_half));
  // `t` 0..1: from no twist over half of it to all.
  const auto wind = [&](float w, float t, std::uint16_t none, std::uint16_t half,
                        std::uint16_t all) {
    const float middle = 1.0f - std::abs(2.0f * t - 1.0f);
    give(half, w * middle);
    give(t < 0.5f ? none : all, w * (1 - middle));
  };
  wind(upper, std::clamp((share_along(shoulder, elbow, p) - 0.12f) / 0.76f, 0.0f, 1.0f),
       helper(HelperJoint::l_upper_arm), helper(HelperJoint::l_upper_arm_mid), number(shoulder));
  wind(fore, std::clamp((share_along(elbow, wrist, p) - 0.12f) / 0.78f, 0.0f, 1.0f),
       helper(HelperJoint::l_forearm_near), helper(HelperJoint::l_forearm_mid),
       helper(HelperJoint::l_forearm_far));
  float thigh = take(number(hip)), shank = take(number(knee));
  hinge(thigh, shank, helper(HelperJoint::l_knee_half));
  give(number(hip), thigh);
  give(number(knee), shank);
}

Influence WeightMap::operator()(const Influence& bones, Vec3 p) const {
  Shares sum;
  float trunk = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const float w = bones.weight[k];
    if (w == 0) continue;
    const Rule& rule = rules_[bones.joint[k]];
    if (rule.kind == Kind::trunk) {
      trunk += w;
    } else if (rule.kind == Kind::foot) {
      // Heel and the arch in front of the midtarsal joint share the foot. Both lie below the
      // subtalar joint, about which a sole stays flat under a leg that leans sideways.
      const bool right = (rule.joint - number(HanimJoint::l_subtalar)) != 0;
      const std::uint16_t arch = number(sided(HanimJoint::l_midtarsal, right));
      const float ahead = (p.z - joints_[arch].center_m.z) / 0.04f;
      const float share = glm::smoothstep(-0.5f, 0.5f, ahead);
      sum[rule.joint] += w * (1 - share);
      sum[arch] += w * share;
    } else {
      sum[rule.joint] += w;
    }
  }
  if (trunk > 0) {
    std::size_t upper = 0;
    while (upper < levels_.size() && levels_[upper].middle_m < p.y) ++upper;
    if (upper == 0) {
      sum[levels_.front().joint] += trunk;
    } else if (upper == levels_.size()) {
      sum[levels_.back().joint] += trunk;
    } else {
      const Level &a = levels_[upper - 1], &b = levels_[upper];
      const float t = glm::smoothstep(a.middle_m, b.middle_m, p.y);
      sum[a.joint] += trunk * (1 - t);
      sum[b.joint] += trunk * t;
    }
  }
  for (const bool right : {false, true}) spread_over_helpers(sum, p, right);
  std::vector<std::pair<float, std::uint16_t>> order;
  for (const auto& [joint, w] : sum) order.emplace_back(w, joint);
  std::sort(order.begin(), order.end(), std::greater<>());
  order.resize(std::min<std::size_t>(order.size(), 4));
  float total = 0;
  for (const auto& [w, joint] : order) total += w;
  Influence out;
  out.weight = {};
  for (std::size_t k = 0; k < order.size(); ++k) {
    out.joint[k] = order[k].second;
    out.weight[k] = order[k].first / total;
  }
  return out;
}

}  // namespace caryatid::bake
