#include "assets/bake/simplify/fast_cost.h"

#include <cmath>
#include <cstring>

namespace caryatid::bake {
namespace {

using F4 = float __attribute__((vector_size(16)));

F4 load(const EdgeBatch::Lanes& lanes) {
  F4 v;
  std::memcpy(&v, lanes, sizeof v);
  return v;
}
struct V3 {
  F4 x, y, z;
};
V3 load3(const EdgeBatch::Lanes* lanes) { return {load(lanes[0]), load(lanes[1]), load(lanes[2])}; }
struct S3 {
  F4 xx, xy, xz, yy, yz, zz;
};
S3 load6(const EdgeBatch::Lanes* l) {
  return {load(l[0]), load(l[1]), load(l[2]), load(l[3]), load(l[4]), load(l[5])};
}
F4 dot(const V3& a, const V3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
V3 operator*(const S3& m, const V3& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
V3 scaled(const V3& a, F4 f) { return {a.x * f, a.y * f, a.z * f}; }
S3 without(const S3& m, const V3& n) {
  return {m.xx - n.x * n.x, m.xy - n.x * n.y, m.xz - n.x * n.z,
          m.yy - n.y * n.y, m.yz - n.y * n.z, m.zz - n.z * n.z};
}
F4 root(F4 v) {
  F4 r;
  for (int i = 0; i < 4; ++i) r[i] = std::sqrt(v[i]);
  return r;
}

constexpr float kRegular = 1e-6f;  // Of the trace; float holds 6e-8.
constexpr float kFlatFirst = 1e-7f;

}  // namespace

void EdgeBatch::evaluate() {
  const V3 h = load3(half), nl = load3(left), nr = load3(right);
  const V3 s0 = load3(n0), s1 = load3(n1);
  const S3 m0 = load6(a0), m1 = load6(a1);
  // The shared triangles contain the edge, so they drop out of everything multiplied by h.
  const V3 c0 = m0 * h, c1 = m1 * h, c = c0 - c1;
  const F4 k = dot(h, c0 + c1);
  const V3 n = s0 + s1 - nl - nr;
  const F4 offset = dot(s1 - s0, h);
  const S3 both = {m0.xx + m1.xx, m0.xy + m1.xy, m0.xz + m1.xz,
                   m0.yy + m1.yy, m0.yz + m1.yz, m0.zz + m1.zz};
  const S3 m = without(without(both, nl), nr);
  const F4 trace = m.xx + m.yy + m.zz;
  const F4 tiny = trace * 0.0f + 1e-37f;
  // The plane of volume preservation: unit normal w, foot point xp.
  const F4 inverse = 1.0f / root(dot(n, n) + tiny);
  const V3 w = scaled(n, inverse);
  const V3 xp = scaled(w, offset * inverse);
  // Two directions in it (Duff et al. 2017, without branches).
  F4 sign;
  for (int i = 0; i < 4; ++i) sign[i] = std::copysign(1.0f, w.z[i]);
  const F4 q = -1.0f / (sign + w.z), b = w.x * w.y * q;
  const V3 u = {1.0f + sign * w.x * w.x * q, sign * b, -sign * w.x};
  const V3 v = {b, sign + w.y * w.y * q, -w.y};
  const V3 mu = m * u, mv = m * v, gradient = c + m * xp;
  const F4 epsilon = kRegular * trace + tiny;
  const F4 uu = dot(u, mu) + epsilon, uv = dot(u, mv), vv = dot(v, mv) + epsilon;
  const F4 g0 = dot(u, gradient), g1 = dot(v, gradient);
  const F4 determinant = uu * vv - uv * uv + tiny;
  const F4 gain = (g0 * g0 * vv - 2.0f * (g0 * g1 * uv) + g1 * g1 * uu) / determinant;
  F4 f = dot(xp, gradient + c) + k - gain;
  for (int i = 0; i < 4; ++i) f[i] = f[i] > 0.0f ? f[i] : 0.0f;
  f = f + kFlatFirst * trace * dot(h, h);
  std::memcpy(cost, &f, sizeof cost);
}

}  // namespace caryatid::bake
