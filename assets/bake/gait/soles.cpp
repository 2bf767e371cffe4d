#include "assets/bake/gait/soles.h"

#include "core/body/hanim.h"

namespace caryatid::bake {

void add_sole_points(Character& character) {
  body::Skeleton skeleton = body::upright_skeleton();
  std::array<std::uint32_t, body::kHanimJointCount> joint_of{};
  for (std::size_t j = 0; j < character.joints.size(); ++j) {
    if (character.joints[j].hanim >= body::kHanimJointCount) continue;  // Helpers of the skin.
    skeleton.center_m[character.joints[j].hanim] = character.joints[j].center_m;
    joint_of[character.joints[j].hanim] = static_cast<std::uint32_t>(j);
  }
  body::derive_soles(skeleton);
  body::SoleFitter fitter;
  for (const Object& object : character.objects)
    for (const Vec3 p : object.mesh.position_m) fitter.add(p);
  fitter.finish(skeleton);
  for (std::uint8_t side = 0; side < 2; ++side) {
    const body::Sole& sole = skeleton.sole[side];
    const auto toes = side == 0 ? body::HanimJoint::l_metatarsal : body::HanimJoint::r_metatarsal;
    const auto ankle = side == 0 ? body::HanimJoint::l_ankle : body::HanimJoint::r_ankle;
    const Vec2 points[] = {sole.heel_back, sole.heel, sole.toe, sole.toe_tip};
    for (std::uint8_t i = 0; i < 4; ++i)
      character.feature_points.push_back(
          {.group = pack::kSoleGroup,
           .index = static_cast<std::uint8_t>(4 * side + i + 1),
           .object = kNone,
           .vertex = joint_of[index_of(i < 2 ? ankle : toes)],
           .position_m = {skeleton.center(ankle).x, points[i].y, points[i].x}});
  }
}

}  // namespace caryatid::bake
