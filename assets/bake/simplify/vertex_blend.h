#pragma once
// Attributes of a vertex that takes the place of an edge: blended from the old surface.
#include <array>
#include <vector>

#include "assets/bake/simplify/object_history.h"
#include "assets/bake/simplify/vec3d.h"

namespace caryatid::bake {

// The point of some triangles that is closest to x: which triangle, and its barycentric weights.
struct SurfacePoint {
  double distance2 = 1e300;
  std::array<std::uint32_t, 3> version{};
  std::array<double, 3> weight{1, 0, 0};

  void consider(const Vec3d& x, const std::array<Vec3d, 3>& corner,
                const std::array<std::uint32_t, 3>& corner_version);
};

// Barycentric weights of the point of triangle abc closest to p (Ericson, Real-Time Collision
// Detection, 5.1.5, by Voronoi regions).
std::array<double, 3> closest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b,
                                          const Vec3d& c);

// Normals are renormalised; of the joints the 4 heaviest stay; displacements below 5 um are
// dropped.
VertexVersion blend_triangle(const std::vector<VertexVersion>& versions, const SurfacePoint& at);
VertexVersion blend_edge(const VertexVersion& a, const VertexVersion& b, double s);

}  // namespace caryatid::bake
