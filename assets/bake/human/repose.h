#pragma once
// From MakeHuman's A-pose to the H-Anim rest pose: arms down along the body, palms to the thighs,
// legs straight and parallel, feet forward. Works on the base human's own bones and weights (they
// were painted for them); the H-Anim skeleton is laid into the result.
#include <span>
#include <vector>

#include "assets/bake/human/makehuman.h"

namespace caryatid::bake {

// How far the arms hang from the body. Angles from the vertical, outwards; figure.cpp opens them as
// far as hips and skirt ask.
struct ArmHang {
  float upper_arm_rad = 0.10f;
  float forearm_rad = 0.02f;
  float clavicle_drop_rad = 0.10f;
};

// Bend of a finger's three bones at rest, from the back of the hand towards the palm: hands that
// hang are never flat. Small enough that finger BAPs still mean what they say.
inline constexpr float kFingerCurl_rad[3] = {0.10f, 0.24f, 0.30f};

// Rigid motion of every bone: p' = head_to + turn * (p - head_from).
struct BoneMotion {
  Quat turn{1, 0, 0, 0};
  Vec3 head_from_m{0}, head_to_m{0};

  Vec3 point(Vec3 p) const { return head_to_m + turn * (p - head_from_m); }
};

// `base_m`: positions of the base (19158) in MakeHuman's pose. `sole_pitch_rad`: how far the feet
// turn toe up against that pose, so that heels come down to the floor. One motion a bone.
std::vector<BoneMotion> rest_pose_motions(const BaseHuman& base, std::span<const Vec3> base_m,
                                          const ArmHang& hang, float sole_pitch_rad);

// Moves skinned positions by dual quaternions: limbs keep their volume where linear blending would
// pinch shoulders and wrists.
void apply_motions(std::span<const BoneMotion> motions, std::span<const Influence> influence,
                   std::span<Vec3> inout_m);

}  // namespace caryatid::bake
