#pragma once
// Pelvis and feet as wanted in the world, turned into the BAPs that put them there.
#include <array>

#include "core/body/bap.h"
#include "core/body/hanim.h"

namespace caryatid::body {

struct FootTarget {
  Vec3 ankle_m{0};         // Where the ankle of a rigid foot would be, world.
  float yaw_rad = 0.0f;    // Direction of the foot about the vertical; 0 along +Z, left +.
  float pitch_rad = 0.0f;  // Toe up +.
  float toe_extension_rad = 0.0f;
};

struct LowerBody {
  Vec3 hips_m{0};                    // Middle of the hip joints, world.
  float heading_rad = 0.0f;          // Of the whole body, left +.
  float torsion_rad = 0.0f;          // Pelvis against the body about +Y: right side forward +.
  float roll_rad = 0.0f;             // Pelvis about +Z: left side up +.
  std::array<FootTarget, 2> foot{};  // [0] left, [1] right.
};

// Writes BAPs 1..23 and 181..186 into `out`. Returns the largest distance, in metres, by which a
// foot could not reach its target (0 in any walk of the styles). Closed form, constant time.
float pose_lower_body(const Skeleton& skeleton, const LowerBody& body, BapFrame& out);

// Where the left or right hip joint is then.
Vec3 hip_position(const Skeleton& skeleton, const LowerBody& body, bool left);

}  // namespace caryatid::body
