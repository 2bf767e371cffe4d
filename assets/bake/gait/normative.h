#pragma once
#include <array>

namespace caryatid::bake {

// Joint angles of typically developing walkers at self-selected speed, mean and standard deviation
// in degrees, every 2 % of the cycle from heel strike. Source: Schwartz, Rozumalski, Trost, "The
// effect of walking speed on the gait of typically developing children", J. Biomechanics 41 (2008)
// 1639-1650. Hip flexion counts from the pelvis: thigh against the vertical = hip - pelvis tilt.
// List: side of the leg up +; rotation: side of the leg forward +.
struct NormativeRow {
  float hip, hip_sd, knee, knee_sd, ankle, ankle_sd, pelvis_tilt, list, list_sd, rotation,
      rotation_sd;
};
const std::array<NormativeRow, 51>& normative_walk();

}  // namespace caryatid::bake
