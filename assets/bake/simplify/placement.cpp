#include "assets/bake/simplify/placement.h"

#include <cmath>

namespace caryatid::bake {
namespace {

// alpha = 1 degree (Lindstrom & Turk): planes closer than that to what is held say nothing new.
constexpr double kSin2Alpha = 3.0458649045213493e-4;
constexpr double kCos2Alpha = 1.0 - kSin2Alpha;
constexpr double kLambda = 0.5;

// A unit vector across `a`, along the axis that `a` leans on least.
Vec3d across(const Vec3d& a) {
  const Vec3d s = a * a;
  if (s.x < s.y && s.x < s.z) return glm::normalize(Vec3d{0, -a.z, a.y});
  if (s.y < s.z) return glm::normalize(Vec3d{a.z, 0, -a.x});
  return glm::normalize(Vec3d{-a.y, a.x, 0});
}

}  // namespace

bool Constraints::try_plane(const Vec3d& a, double b) {
  const double a2 = length2(a);
  if (count_ == 3 || !(a2 > 1e-200)) return false;
  if (count_ == 1) {
    const double along = dot(a_[0], a);
    if (!(along * along < a2 * kCos2Alpha)) return false;
  } else if (count_ == 2) {
    const Vec3d line = cross(a_[0], a_[1]);
    const double along = dot(line, a);
    if (!(along * along > length2(line) * a2 * kSin2Alpha)) return false;
  }
  const double scale = 1.0 / std::sqrt(a2);
  a_[count_] = a * scale;
  b_[count_] = b * scale;
  ++count_;
  return true;
}

void Constraints::try_quadratic(const Quadratic& q) {
  if (count_ == 0) {
    try_plane({q.h.xx, q.h.xy, q.h.xz}, -q.c.x);
    try_plane({q.h.xy, q.h.yy, q.h.yz}, -q.c.y);
    try_plane({q.h.xz, q.h.yz, q.h.zz}, -q.c.z);
  } else if (count_ == 1) {
    const Vec3d u = across(a_[0]);
    const Vec3d v = cross(a_[0], u);
    try_plane(q.h * u, -dot(u, q.c));
    try_plane(q.h * v, -dot(v, q.c));
  } else if (count_ == 2) {
    const Vec3d u = cross(a_[0], a_[1]);
    try_plane(q.h * u, -dot(u, q.c));
  }
}

std::optional<Vec3d> Constraints::point() const {
  if (count_ < 3) return std::nullopt;
  const Vec3d bc = cross(a_[1], a_[2]), ca = cross(a_[2], a_[0]), ab = cross(a_[0], a_[1]);
  const double determinant = dot(a_[0], bc);
  if (determinant == 0.0) return std::nullopt;
  const Vec3d x = (b_[0] * bc + b_[1] * ca + b_[2] * ab) / determinant;
  if (!std::isfinite(x.x + x.y + x.z)) return std::nullopt;
  return x;
}

void EdgeSums::add_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  add_triangle(cross(b - a, c - a), dot(cross(a, b), c), 1.0);
}

void EdgeSums::add_triangle(const Vec3d& n, double d, double weight) {
  normal += n;
  offset += d;
  volume.h.add(Sym3::outer(n), weight);
  volume.c -= weight * d * n;
  volume.k += weight * d * d;
}

void EdgeSums::add_border(const Vec3d& s, const Vec3d& t) {
  const Vec3d u = t - s, w = cross(t, s);
  border = true;
  e1 += u;
  e2 += w;
  boundary.h.add(Sym3::cross_square(u), 1.0);
  boundary.c += cross(u, w);
  boundary.k += length2(w);
}

std::optional<Vec3d> best_position(const EdgeSums& sums) {
  Constraints planes;
  planes.try_plane(sums.normal, sums.offset);
  if (sums.border)
    planes.try_quadratic({Sym3::cross_square(sums.e1), cross(sums.e1, sums.e2), 0.0});
  if (planes.count() < 3) {
    // Volume and boundary optimisation in one quadratic (1999 form): 9 = (1/2) / (1/18).
    Quadratic q;
    q.add(sums.volume, kLambda);
    if (sums.border)
      q.add(sums.boundary, 9.0 * (1.0 - kLambda) * sums.border_weight * sums.edge_length2);
    planes.try_quadratic(q);
  }
  if (planes.count() < 3)
    planes.try_quadratic(
        {{sums.ring_count, 0, 0, sums.ring_count, 0, sums.ring_count}, -sums.ring_sum, 0.0});
  return planes.point();
}

double collapse_cost(const EdgeSums& sums, const Vec3d& x) {
  double cost = kLambda / 36.0 * sums.volume.twice(x);
  if (sums.border) cost += (1.0 - kLambda) * sums.edge_length2 / 4.0 * sums.boundary.twice(x);
  return cost > 0.0 ? cost : 0.0;
}

}  // namespace caryatid::bake
