#pragma once
// Double-precision vectors of the simplifier: the build is in double, storage in float.
#include "core/base/vec.h"

namespace caryatid::bake {

using Vec3d = glm::dvec3;

inline double length2(const Vec3d& v) { return glm::dot(v, v); }

// A symmetric 3x3 matrix.
struct Sym3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  static Sym3 outer(const Vec3d& v) {
    return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
  }
  // (u.u) I - u u^T: x -> u x (x x u), the square of the cross product.
  static Sym3 cross_square(const Vec3d& u) {
    return {u.y * u.y + u.z * u.z, -u.x * u.y, -u.x * u.z,
            u.x * u.x + u.z * u.z, -u.y * u.z, u.x * u.x + u.y * u.y};
  }
  void add(const Sym3& o, double f) {
    xx += f * o.xx;
    xy += f * o.xy;
    xz += f * o.xz;
    yy += f * o.yy;
    yz += f * o.yz;
    zz += f * o.zz;
  }
  Vec3d operator*(const Vec3d& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }
};

}  // namespace caryatid::bake
