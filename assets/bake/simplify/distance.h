#pragma once
// How far two surfaces are apart, measured by sampling (as the Metro tool does).
#include <cstdint>
#include <vector>

#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bake {

// Finds the closest point of a surface. Keeps its own copy of the triangles.
class SurfaceTree {
 public:
  explicit SurfaceTree(const Surface& surface);
  // Distance from p, at most `bound`. O(log n) on usual surfaces.
  double distance(const Vec3d& p, double bound = 1e300) const;

 private:
  struct Node {
    Vec3d low, high;
    std::uint32_t first, count;  // Triangles of a leaf; else children first, first + 1; count 0.
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  double distance2(const Node& node, const Vec3d& p) const;

  std::vector<std::array<Vec3d, 3>> triangles_;
  std::vector<Node> nodes_;
};

// In units of the surface; d over a surface S is d(p) = min |p - q|, q on the other.
struct OneSided {
  double mean = 0, rms = 0, max = 0;
};
struct SurfaceError {
  OneSided forward, backward;  // From the first surface to the second, and back.
  double hausdorff() const { return forward.max > backward.max ? forward.max : backward.max; }
  double mean() const { return 0.5 * (forward.mean + backward.mean); }
  double rms() const;
};

// Samples uniform by area, on average `samples_per_face` a triangle of each surface (at least 30000
// and all vertices besides). Same seed, same figures.
SurfaceError measure_error(const Surface& a, const Surface& b, double samples_per_face = 10,
                           std::uint64_t seed = 1);
// The same against trees at hand: of many levels against one original.
OneSided one_sided(const Surface& from, const SurfaceTree& to, double samples_per_face,
                   std::uint64_t seed);

}  // namespace caryatid::bake
