#pragma once
// Joints that no BAP names, between those of H-Anim: they spread a twist along a limb and halve the
// bend of elbow and knee, so that linear skinning keeps the girth of both (no candy-wrapper, no
// collapsing knee). They follow from the pose alone; skins may or may not use them.
#include <span>

#include "core/body/hanim.h"

namespace caryatid::body {

// Left before right, as HanimJoint.
enum class HelperJoint : std::uint8_t {
  l_upper_arm,  // The shoulder's turn without its twist: skin near the shoulder.
  r_upper_arm,
  l_upper_arm_mid,  // With half of it.
  r_upper_arm_mid,
  l_elbow_half,  // Half of the elbow's flexion.
  r_elbow_half,
  l_forearm_near,  // The elbow's turn without its twist: skin near the elbow,
  r_forearm_near,
  l_forearm_mid,  // with half of the elbow's and of the wrist's twist,
  r_forearm_mid,
  l_forearm_far,  // with all of both: skin near the wrist.
  r_forearm_far,
  l_knee_half,  // Half of the knee's flexion.
  r_knee_half,
  count
};
inline constexpr std::size_t kHelperJointCount = static_cast<std::size_t>(HelperJoint::count);
// Numbers of joints as skins (pack::Joint::hanim) use them: H-Anim's first, then these.
inline constexpr std::size_t kSkinJointCount = kHanimJointCount + kHelperJointCount;
static_assert(kSkinJointCount <= kMaxJoints);
constexpr std::size_t index_of(HelperJoint joint) {
  return kHanimJointCount + static_cast<std::size_t>(joint);
}

// The joint whose centre a helper has, and which may stand in for it.
HanimJoint helper_owner(HelperJoint joint);

// io_pose: kSkinJointCount long, the first kHanimJointCount filled by PoseJob; fills the rest.
// invalid_argument: another length. Cost: constant, square roots only.
Status pose_helpers(const Skeleton& skeleton, std::span<Affine> io_pose);

}  // namespace caryatid::body
