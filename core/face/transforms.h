#pragma once
// What FAPs turn rather than deform: eyeballs, jaw (which carries lower teeth and tongue) and head.
// The scene adds these turns to the joints of the same name; the skin of the jaw follows by FAT.
#include "core/base/vec.h"
#include "core/face/fap.h"
#include "core/pack/pack.h"

namespace caryatid::face {

// Lengths that the turns depend on. From the pack: FAPU of pack::Character, centre of the jaw joint
// (on the axis through both temporomandibular joints), feature point 2.1 (lowest point of the
// chin).
struct TransformGeometry {
  float eye_separation_m = 0.0f;
  float iris_diameter_m = 0.0f;
  float mouth_nose_m = 0.0f;
  float mouth_width_m = 0.0f;
  Vec3 jaw_center_m{0};
  Vec3 chin_m{0};
};

// Local rotations about the joint's centre and shifts in metres, all in the frame of the head at
// rest (+X left, +Y up, +Z forward).
struct FaceTransforms {
  Quat head{1, 0, 0, 0};  // FAPs 48-50: yaw after pitch after roll, about the top of the spine.
  Quat left_eye{1, 0, 0, 0}, right_eye{1, 0, 0, 0};         // FAPs 23-26.
  float left_eye_thrust_m = 0, right_eye_thrust_m = 0;      // FAPs 27, 28, along +Z.
  float left_pupil_growth_m = 0, right_pupil_growth_m = 0;  // FAPs 29, 30: change of diameter.
  Quat jaw{1, 0, 0, 0};                                     // FAP 3.
  Vec3 jaw_shift_m{0};                                      // FAPs 14, 15.
};

// Angle about +X that lowers the chin by `drop_m` when the jaw turns about its joint; the same
// curve shapes the skin in the bake. Drops beyond a right angle's worth saturate.
float jaw_angle_rad(const TransformGeometry& geometry, float drop_m);

// O(1). Values are taken as they are: soften them first (core/face/mixer.h does).
FaceTransforms evaluate_transforms(const TransformGeometry& geometry, const FapFrame& frame);

// The turn by `angle_rad` about a unit axis, with the trigonometry that is the same everywhere.
Quat turn(Vec3 axis, float angle_rad);

}  // namespace caryatid::face
