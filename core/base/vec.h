#pragma once
// Names for the vector types of the project. GLM is the library; nothing else includes it directly.
// Frame everywhere: right-handed, metres, +X to the figure's left, +Y up, +Z forward (out of the
// face). GLM's trigonometry calls libm, whose last bits differ between machines: paths whose
// results are hashed use core/base/trig.h instead.
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace caryatid {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;  // Column-major, as GL takes it.
using Mat4 = glm::mat4;
using Quat = glm::quat;

// A rigid or affine transform as three rows of four: p' = rows * (p, 1). The form that shaders take
// (3 uniform vectors a bone).
struct Affine {
  Vec4 row[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  Vec3 point(Vec3 p) const {
    const Vec4 h{p, 1.0f};
    return {glm::dot(row[0], h), glm::dot(row[1], h), glm::dot(row[2], h)};
  }
  Vec3 direction(Vec3 d) const {
    const Vec4 h{d, 0.0f};
    return {glm::dot(row[0], h), glm::dot(row[1], h), glm::dot(row[2], h)};
  }
};

// a after b: the transform p -> a(b(p)).
inline Affine operator*(const Affine& a, const Affine& b) {
  Affine out;
  for (int r = 0; r < 3; ++r) {
    const Vec4 ar = a.row[r];
    out.row[r] = ar.x * b.row[0] + ar.y * b.row[1] + ar.z * b.row[2] + Vec4{0, 0, 0, ar.w};
  }
  return out;
}

// The transform that turns by unit quaternion `q` about the origin, then moves by `t`.
inline Affine make_affine(const Quat& q, Vec3 t) {
  const Mat3 m = glm::mat3_cast(q);
  Affine out;
  for (int r = 0; r < 3; ++r) out.row[r] = {m[0][r], m[1][r], m[2][r], t[r]};
  return out;
}

}  // namespace caryatid
