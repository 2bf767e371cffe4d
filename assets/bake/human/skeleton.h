#pragma once
// The H-Anim skeleton of a re-posed figure, and its skin weights.
#include <map>
#include <span>
#include <vector>

#include "assets/bake/human/makehuman.h"
#include "core/body/helper_joints.h"

namespace caryatid::bake {

// All joints in the order of body::HanimJoint (parents first), then of body::HelperJoint.
// `bone_head_m`: where every bone's head lies in the rest pose; `eye_center_m`: left, right.
std::vector<Joint> hanim_joints(const BaseHuman& base, std::span<const Vec3> bone_head_m,
                                std::span<const Vec3, 2> eye_center_m);

// Turns weights on MakeHuman's bones into weights on H-Anim joints. Fingers, limbs and shoulders
// map bone by bone; the trunk's and neck's share is spread over the vertebrae by the vertex's
// height, smoothly. Only every second or third vertebra carries skin, so that a jacket stays within
// the 30 bones of a draw; turns of the vertebrae between still arrive, composed along the chain.
// Arms and knees use the helper joints.
class WeightMap {
 public:
  WeightMap(const BaseHuman& base, std::span<const Joint> joints);
  Influence operator()(const Influence& bones, Vec3 rest_position_m) const;

 private:
  struct Level {
    std::uint16_t joint;
    float middle_m;  // Height at which the joint alone carries the skin.
  };
  enum class Kind : std::uint8_t { joint, trunk, foot };
  struct Rule {
    Kind kind = Kind::joint;
    std::uint16_t joint = 0;
  };
  using Shares = std::map<std::uint16_t, float>;  // By joint.
  Rule rule_of(const std::string& bone) const;
  float share_along(body::HanimJoint from, body::HanimJoint to, Vec3 p) const;
  void spread_over_helpers(Shares& sum, Vec3 p, bool right) const;

  std::span<const Joint> joints_;
  std::vector<Rule> rules_;    // By bone.
  std::vector<Level> levels_;  // Upwards.
};

}  // namespace caryatid::bake
