#include "assets/bake/simplify/fast_cost.h"

#include <cstring>

namespace caryatid::bake {
namespace {

using F4 = float __attribute__((vector_size(16)));
using I4 = std::int32_t __attribute__((vector_size(16)));

[[gnu::always_inline]] inline F4 load(const EdgeBatch::Lanes& lanes) {
  F4 v;
  std::memcpy(&v, lanes, sizeof v);
  return v;
}
struct V3 {
  F4 x, y, z;
};
[[gnu::always_inline]] inline V3 load3(const EdgeBatch::Lanes* lanes) {
  return {load(lanes[0]), load(lanes[1]), load(lanes[2])};
}
struct S3 {
  F4 xx, xy, xz, yy, yz, zz;
};
[[gnu::always_inline]] inline S3 load6(const EdgeBatch::Lanes* l) {
  return {load(l[0]), load(l[1]), load(l[2]), load(l[3]), load(l[4]), load(l[5])};
}
// area_weight() of each lane.
[[gnu::always_inline]] inline F4 weight(F4 n2) {
  return std::bit_cast<F4>(0x3F800000 + 0x03F80000 - (std::bit_cast<I4>(n2) >> 4));
}
[[gnu::always_inline]] inline F4 dot(const V3& a, const V3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline V3 operator+(const V3& a, const V3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline V3 operator-(const V3& a, const V3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline V3 operator*(const S3& m, const V3& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
[[gnu::always_inline]] inline V3 scaled(const V3& a, F4 f) { return {a.x * f, a.y * f, a.z * f}; }
[[gnu::always_inline]] inline S3 without(const S3& m, const V3& n) {
  const V3 w = scaled(n, weight(dot(n, n)));
  return {m.xx - w.x * n.x, m.xy - w.x * n.y, m.xz - w.x * n.z,
          m.yy - w.y * n.y, m.yz - w.y * n.z, m.zz - w.z * n.z};
}
// 1 / sqrt(v) by Newton's method from the halved exponent: plain arithmetic runs in all lanes.
[[gnu::always_inline]] inline F4 inverse_root(F4 v) {
  F4 y = std::bit_cast<F4>(0x5F3759DF - (std::bit_cast<I4>(v) >> 1));
  for (int i = 0; i < 3; ++i) y = y * (1.5f - 0.5f * v * y * y);
  return y;
}
// 1 with the sign of v.
[[gnu::always_inline]] inline F4 sign_of(F4 v) {
  return std::bit_cast<F4>((std::bit_cast<I4>(v) & INT32_MIN) | 0x3F800000);
}

constexpr float kSin2Alpha = 3.0458649e-4f;  // alpha = 1 degree, as in placement.cpp.
constexpr float kTan2Alpha = 3.0467929e-4f;

}  // namespace

void EdgeBatch::evaluate() {
  const V3 h = load3(half), nl = load3(left), nr = load3(right);
  const V3 s0 = load3(q0), s1 = load3(q1);
  const S3 m0 = load6(q0 + 3), m1 = load6(q1 + 3);
  // The shared triangles contain the edge, so they drop out of everything multiplied by h.
  const V3 c0 = m0 * h, c1 = m1 * h, c = c0 - c1;
  const F4 k = dot(h, c0 + c1);
  const V3 n = s0 + s1 - nl - nr;
  const F4 offset = dot(s1 - s0, h);
  const S3 both = {m0.xx + m1.xx, m0.xy + m1.xy, m0.xz + m1.xz,
                   m0.yy + m1.yy, m0.yz + m1.yz, m0.zz + m1.zz};
  const S3 m = without(without(both, nl), nr);
  const F4 trace = m.xx + m.yy + m.zz;
  const F4 tiny = trace * 0.0f + 1e-30f;
  // The plane of volume preservation: unit normal w, foot point xp.
  const F4 inverse = inverse_root(dot(n, n) + tiny);
  const V3 w = scaled(n, inverse);
  const V3 xp = scaled(w, offset * inverse);
  // Two directions in it (Duff et al. 2017, without branches).
  const F4 sign = sign_of(w.z);
  const F4 q = -1.0f / (sign + w.z), b = w.x * w.y * q;
  const V3 u = {1.0f + sign * w.x * w.x * q, sign * b, -sign * w.x};
  const V3 v = {b, sign + w.y * w.y * q, -w.y};
  // The two planes of volume optimisation, as equations in (s, t): x = xp + s u + t v. Each counts
  // if it is further than alpha from what is held (3-2, 3-3); where one is missing, triangle shape
  // draws to the middle of the edge, and so to the least s^2 + t^2.
  // In parts of the trace, for powers of lengths soon leave the range of float.
  const F4 part = 1.0f / (trace + tiny);
  const V3 gradient = c + m * xp, scaled_gradient = scaled(gradient, part);
  const V3 mu = scaled(m * u, part), mv = scaled(m * v, part);
  const F4 uu = dot(u, mu), uv = dot(u, mv), vv = dot(v, mv), wu = dot(w, mu), wv = dot(w, mv);
  const F4 g0 = dot(u, scaled_gradient), g1 = dot(v, scaled_gradient);
  const F4 row0 = uu * uu + uv * uv, row1 = uv * uv + vv * vv;
  const F4 determinant = uu * vv - uv * uv;
  const auto take0 = row0 > kTan2Alpha * (wu * wu) + tiny;
  const auto take1 = row1 > kTan2Alpha * (wv * wv) + tiny;
  const auto both_rows =
      take0 & (determinant * determinant > kSin2Alpha * (row0 * (row1 + wv * wv)) + tiny);
  const F4 zero = trace * 0.0f;
  const F4 along0 = -g0 / (row0 + tiny), along1 = -g1 / (row1 + tiny);
  const F4 inverse_determinant = 1.0f / (both_rows ? determinant : zero + 1.0f);
  const F4 s = both_rows ? (g1 * uv - g0 * vv) * inverse_determinant
               : take0   ? along0 * uu
               : take1   ? along1 * uv
                         : zero;
  const F4 t = both_rows ? (g0 * uv - g1 * uu) * inverse_determinant
               : take0   ? along0 * uv
               : take1   ? along1 * vv
                         : zero;
  F4 f = dot(xp, gradient + c) + k +
         trace * (2.0f * (g0 * s + g1 * t) + (s * (uu * s + 2.0f * (uv * t)) + vv * (t * t)));
  f = f > 0.0f ? f : zero;
  f = f + kFlatFirst * trace * dot(h, h);
  std::memcpy(cost, &f, sizeof cost);
}

}  // namespace caryatid::bake
