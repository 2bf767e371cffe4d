#pragma once
// Where the vertex goes that replaces an edge, and what that costs (Lindstrom & Turk 1998, 1999;
// thesis equations 3-1 to 3-8). Everything is in a local frame whose origin is the middle of the
// edge: no cancellation, and the volume of a closed mesh drifts by rounding only.
#include <optional>

#include "assets/bake/simplify/vec3d.h"

namespace caryatid::bake {

// 1/2 x.H.x + c.x (+ k/2): the quadratic objectives of the method. H is symmetric.
struct Quadratic {
  Sym3 h;
  Vec3d c{0};
  double k = 0;

  // Twice the value, i.e. x.H.x + 2 c.x + k.
  double twice(const Vec3d& x) const { return dot(x, h * x) + 2 * dot(c, x) + k; }
  Quadratic& add(const Quadratic& other, double factor) {
    h.add(other.h, factor);
    c += factor * other.c;
    k += factor * other.k;
    return *this;
  }
};

// At most three planes a.x = b, accepted only if well apart from those already held.
class Constraints {
 public:
  // Equations 3-1 to 3-3 with alpha = 1 degree.
  bool try_plane(const Vec3d& a, double b);
  // Equation 3-5: as many further planes as the minimum of q gives within those held.
  void try_quadratic(const Quadratic& q);
  int count() const { return count_; }
  std::optional<Vec3d> point() const;

 private:
  Vec3d a_[3];
  double b_[3];
  int count_ = 0;
};

// What the neighbourhood of an edge says, summed over the triangles and border edges that touch it.
struct EdgeSums {
  Vec3d normal{0};    // Sum of n = (x1 - x0) x (x2 - x0).
  double offset = 0;  // Sum of d = (x0 x x1) . x2.
  Quadratic volume;   // Sum of (n.x - d)^2.
  bool border = false;
  Vec3d e1{0}, e2{0};  // Sums over border edges (s, t): x_t - x_s and x_t x x_s.
  Quadratic boundary;  // Sum of |e1 x (x_t - x)|^2.
  Vec3d ring_sum{0};   // Of the neighbours of both ends.
  double ring_count = 0, ring_square = 0;  // How many, and the sum of their squared distances.
  double edge_length2 = 0;                 // Of the edge.
  double border_weight = 1;                // Of the border terms beside those of volume.

  void add_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c);
  // The same from n and d; `weight` counts in the quadratic only, never in the constraint.
  void add_triangle(const Vec3d& n, double d, double weight);
  void add_border(const Vec3d& s, const Vec3d& t);
};

// The best position, by volume preservation, boundary preservation, volume and boundary
// optimisation, triangle shape, in this order. Nothing when three planes do not come together.
std::optional<Vec3d> best_position(const EdgeSums& sums);

// lambda f_V + (1 - lambda) L^2 f_B with lambda = 1/2 (equation 3-8 on closed meshes, halved).
double collapse_cost(const EdgeSums& sums, const Vec3d& x);

}  // namespace caryatid::bake
