#include "core/scene/camera.h"

#include <algorithm>

#include "core/base/trig.h"

namespace caryatid::scene {
namespace {

// Half of the vertical angle of view: 12 degrees, an 85 mm lens on 35 mm film turned upright.
constexpr float kHalfFieldOfView_rad = 12.0f * kPi / 180.0f;
constexpr float kFaceToMiddle_m = 0.085f;  // From the eyes back to the middle of the head.
constexpr float kNear_m = 0.1f, kFar_m = 30.0f;

Vec3 around(float yaw_rad, float pitch_rad) {
  const SinCos y = sin_cos(yaw_rad), p = sin_cos(pitch_rad);
  return {y.sin * p.cos, p.sin, y.cos * p.cos};
}

Mat4 look_at(Vec3 eye, Vec3 target) {
  const Vec3 back = glm::normalize(eye - target);
  const Vec3 right = glm::normalize(glm::cross(Vec3{0, 1, 0}, back));
  const Vec3 up = glm::cross(back, right);
  Mat4 m{1.0f};
  const Vec3 axes[3] = {right, up, back};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[c][r] = axes[r][c];
    m[3][r] = -glm::dot(axes[r], eye);
  }
  return m;
}

}  // namespace

Subject subject_of(const pack::View& pack) {
  Subject subject;
  subject.stature_m = pack.character->stature_m;
  const auto* left = pack::find_feature_point(pack, 3, 5);
  const auto* right = pack::find_feature_point(pack, 3, 6);
  if (left != nullptr && right != nullptr)
    for (int k = 0; k < 3; ++k)
      subject.eyes_m[k] = 0.5f * (left->position_m[k] + right->position_m[k]);
  return subject;
}

Framing framing(View view, const Subject& subject) {
  Framing f;
  // A face stands a little above the middle of a portrait.
  const Vec3 face = subject.eyes_m + Vec3{0, -0.045f, 0};
  f.target_m = face;
  f.visible_height_m = 0.36f;
  f.visible_width_m = 0.27f;
  switch (view) {
    case View::head:
      break;
    case View::left:
      f.target_m.z -= kFaceToMiddle_m;
      f.direction = around(kPi / 2.0f, 0.0f);
      break;
    case View::right:
      f.target_m.z -= kFaceToMiddle_m;
      f.direction = around(-kPi / 2.0f, 0.0f);
      break;
    case View::three_quarter:
      f.target_m.z -= 0.5f * kFaceToMiddle_m;
      f.direction = around(0.65f, 0.03f);
      break;
    case View::bust:
      f.target_m = subject.eyes_m + Vec3{0, -0.19f, 0};
      f.visible_height_m = 0.78f;
      f.visible_width_m = 0.56f;
      break;
    case View::body:
      f.target_m = {subject.eyes_m.x, subject.stature_m * 0.5f, subject.eyes_m.z - 0.08f};
      f.direction = around(0.0f, 0.04f);
      f.visible_height_m = subject.stature_m * 1.14f;
      f.visible_width_m = 0.85f;
      break;
    case View::feet:
      f.target_m = {subject.eyes_m.x, 0.14f, subject.eyes_m.z - 0.05f};
      f.direction = around(0.5f, 0.25f);
      f.visible_height_m = 0.5f;
      f.visible_width_m = 0.6f;
      break;
  }
  return f;
}

Framing blend(const Framing& a, const Framing& b, float t) {
  Framing f;
  f.target_m = a.target_m + (b.target_m - a.target_m) * t;
  f.direction = glm::normalize(a.direction + (b.direction - a.direction) * t);
  f.visible_height_m = a.visible_height_m + (b.visible_height_m - a.visible_height_m) * t;
  f.visible_width_m = a.visible_width_m + (b.visible_width_m - a.visible_width_m) * t;
  return f;
}

Camera make_camera(const Framing& framing, float aspect, std::uint32_t turn_degrees,
                   const Window& window) {
  const bool sideways = turn_degrees == 90 || turn_degrees == 270;
  const float across = std::max(window.x1 - window.x0, 0.05f);
  const float upright = std::max(window.y1 - window.y0, 0.05f);
  const float seen_aspect = (sideways ? 1.0f / aspect : aspect) * (across / upright);
  const float height_m =
      std::max(framing.visible_height_m, framing.visible_width_m / std::max(seen_aspect, 0.01f));
  const SinCos half = sin_cos(kHalfFieldOfView_rad);
  const float tangent = half.sin / half.cos;
  Camera c;
  c.position_m = framing.target_m + framing.direction * (0.5f * height_m / tangent);
  c.view = look_at(c.position_m, framing.target_m);
  Mat4 p{0.0f};
  p[0][0] = 1.0f / (tangent * seen_aspect);
  p[1][1] = 1.0f / tangent;
  p[2][2] = -(kFar_m + kNear_m) / (kFar_m - kNear_m);
  p[2][3] = -1.0f;
  p[3][2] = -2.0f * kFar_m * kNear_m / (kFar_m - kNear_m);
  // The window's own clip space becomes a part of the picture's.
  Mat4 place{1.0f};
  place[0][0] = across;
  place[1][1] = upright;
  place[3][0] = window.x0 + window.x1 - 1.0f;
  place[3][1] = 1.0f - window.y0 - window.y1;
  // The mounted panel shows the picture turned: rotate clip space against it. Exact for 90 degrees.
  constexpr float kCos[4] = {1, 0, -1, 0}, kSin[4] = {0, 1, 0, -1};
  const std::uint32_t quarter = (turn_degrees / 90) % 4;
  Mat4 turn{1.0f};
  turn[0][0] = turn[1][1] = kCos[quarter];
  turn[0][1] = -kSin[quarter];
  turn[1][0] = kSin[quarter];
  c.projection = turn * (place * p);
  return c;
}

Vec3 seen_at(const Camera& camera, Vec3 point_m, float width, float height,
             std::uint32_t turn_degrees) {
  const Vec4 clip = camera.projection * (camera.view * Vec4{point_m, 1.0f});
  const float w = clip.w > 1e-4f ? clip.w : 1e-4f;
  constexpr float kCos[4] = {1, 0, -1, 0}, kSin[4] = {0, 1, 0, -1};
  const std::uint32_t quarter = (turn_degrees / 90) % 4;
  const float x = (kCos[quarter] * clip.x - kSin[quarter] * clip.y) / w;
  const float y = (kSin[quarter] * clip.x + kCos[quarter] * clip.y) / w;
  return {0.5f * (x + 1.0f) * width, 0.5f * (1.0f - y) * height, clip.w};
}

}  // namespace caryatid::scene
