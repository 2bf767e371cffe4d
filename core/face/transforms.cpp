#include "core/face/transforms.h"

#include <algorithm>
#include <cmath>

#include "core/base/trig.h"

namespace caryatid::face {
namespace {

constexpr float kAngleUnit_rad = 1e-5f;
constexpr float kFapuSteps = 1024.0f;

float fapu(const FapFrame& frame, int fap, float neutral_m) {
  return frame.get(fap) * neutral_m / kFapuSteps;
}

Quat eye_turn(const FapFrame& frame, int yaw_fap, int pitch_fap) {
  // Listing's law asks for no torsion; yaw after pitch keeps it below 2 degrees in our range.
  return turn({0, 1, 0}, frame.get(yaw_fap) * kAngleUnit_rad) *
         turn({1, 0, 0}, frame.get(pitch_fap) * kAngleUnit_rad);
}

}  // namespace

Quat turn(Vec3 axis, float angle_rad) {
  const SinCos half = sin_cos(0.5f * angle_rad);
  return {half.cos, axis.x * half.sin, axis.y * half.sin, axis.z * half.sin};
}

float jaw_angle_rad(const TransformGeometry& geometry, float drop_m) {
  const float y = geometry.chin_m.y - geometry.jaw_center_m.y;
  const float z = geometry.chin_m.z - geometry.jaw_center_m.z;
  const float radius = std::sqrt(y * y + z * z);
  if (!(radius > 0.0f)) return 0.0f;
  return acos_of((y - drop_m) / radius) - acos_of(y / radius);
}

FaceTransforms evaluate_transforms(const TransformGeometry& geometry, const FapFrame& frame) {
  FaceTransforms out;
  // FAP 50 is positive towards the figure's right, which is the positive turn about +Z.
  out.head = turn({0, 1, 0}, frame.get(49) * kAngleUnit_rad) *
             turn({1, 0, 0}, frame.get(48) * kAngleUnit_rad) *
             turn({0, 0, 1}, frame.get(50) * kAngleUnit_rad);
  out.left_eye = eye_turn(frame, 23, 25);
  out.right_eye = eye_turn(frame, 24, 26);
  out.left_eye_thrust_m = fapu(frame, 27, geometry.eye_separation_m);
  out.right_eye_thrust_m = fapu(frame, 28, geometry.eye_separation_m);
  out.left_pupil_growth_m = fapu(frame, 29, geometry.iris_diameter_m);
  out.right_pupil_growth_m = fapu(frame, 30, geometry.iris_diameter_m);
  out.jaw = turn({1, 0, 0}, jaw_angle_rad(geometry, fapu(frame, 3, geometry.mouth_nose_m)));
  // FAP 15 is positive towards the figure's right, which is -X.
  out.jaw_shift_m = {-fapu(frame, 15, geometry.mouth_width_m), 0.0f,
                     fapu(frame, 14, geometry.mouth_nose_m)};
  return out;
}

}  // namespace caryatid::face
