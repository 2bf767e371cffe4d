#pragma once
// What lies around an edge, as sums for placement.h.
#include "assets/bake/simplify/half_edges.h"
#include "assets/bake/simplify/placement.h"

namespace caryatid::bake {

// Visits the triangles that touch either end of h once each, as f(a half-edge of the triangle).
template <class F>
void for_edge_triangles(const HalfEdges& mesh, std::uint32_t h, F&& f) {
  const std::uint32_t a = mesh.from[h], b = mesh.to(h);
  mesh.for_fan(a, [&](std::uint32_t g) { f(g); });
  mesh.for_fan(b, [&](std::uint32_t g) {
    if (mesh.to(g) != a && mesh.opposite(g) != a) f(g);
  });
}

// `at` gives the position of a vertex, in the frame of the caller's choice; `weight` what the
// squared volume of a triangle counts, by its n.n.
template <class Position, class Weight>
EdgeSums sums_of(const HalfEdges& mesh, std::uint32_t h, Position&& at, Weight&& weight) {
  EdgeSums sums;
  const std::uint32_t a = mesh.from[h], b = mesh.to(h);
  sums.edge_length2 = length2(at(b) - at(a));
  const bool border = mesh.on_border(a) || mesh.on_border(b);
  for_edge_triangles(mesh, h, [&](std::uint32_t g) {
    const std::uint32_t v[3] = {mesh.from[g], mesh.to(g), mesh.opposite(g)};
    const Vec3d p[3] = {at(v[0]), at(v[1]), at(v[2])};
    const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
    sums.add_triangle(n, dot(cross(p[0], p[1]), p[2]), weight(length2(n)));
    for (int i = 0; i < 3; ++i) {
      if (v[i] != a && v[i] != b) {
        sums.ring_sum += p[i];
        sums.ring_square += length2(p[i]);
        sums.ring_count += 1;
      }
      if (!border) continue;
      const std::uint32_t e = i == 0 ? g : i == 1 ? next_in_triangle(g) : prev_in_triangle(g);
      const std::uint32_t s = v[i], t = v[(i + 1) % 3];
      if (mesh.twin[e] == kNoHalfEdge && (s == a || s == b || t == a || t == b))
        sums.add_border(p[i], p[(i + 1) % 3]);
    }
  });
  return sums;
}

template <class Position>
EdgeSums sums_of(const HalfEdges& mesh, std::uint32_t h, Position&& at) {
  return sums_of(mesh, h, at, [](double) { return 1.0; });
}

}  // namespace caryatid::bake
