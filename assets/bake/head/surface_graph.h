#pragma once
// A foreign skin as a graph of edges: ways along it, what a closed way encloses, cuts.
#include <cstdint>
#include <span>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake::foreign {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class SurfaceGraph {
 public:
  SurfaceGraph(std::span<const Vec3> position_m, const Triangles& triangles);

  std::span<const std::uint32_t> neighbours(std::uint32_t v) const { return neighbours_[v]; }

  // The way along edges that is short and keeps near the straight line between its ends; borders
  // and sharp edges are preferred, as the rims of lids and lips are one or the other. `barred`
  // vertices (empty
  // or by vertex) are not passed, but may be ends. Empty when there is none.
  std::vector<std::uint32_t> way(std::uint32_t from, std::uint32_t to,
                                 const std::vector<bool>& barred = {}) const;
  // By vertex: can be reached from `from` without passing a barred one.
  std::vector<bool> reached(std::uint32_t from, const std::vector<bool>& barred) const;

 private:
  std::span<const Vec3> position_m_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::vector<std::vector<float>> ease_;  // By vertex and neighbour: factor on an edge's length.
};

// Label of the connected part of every vertex, from 0.
std::vector<std::uint32_t> parts_of(std::size_t vertices, const Triangles& triangles);

// Cuts the surface open along a chain of vertices between its two ends, which stay whole: every
// inner vertex gets a twin, which the triangles to the left of the chain (seen from outside, in its
// direction) take. Returns the twin of every vertex of the chain; ends are their own.
std::vector<std::uint32_t> cut_along(std::span<const std::uint32_t> chain,
                                     std::vector<Vec3>& inout_position_m,
                                     Triangles& inout_triangles);

}  // namespace caryatid::bake::foreign
