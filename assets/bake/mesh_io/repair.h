#pragma once
// Makes a surface out of what files hold, and says what it did.
#include <string>
#include <vector>

#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bake {

struct RepairReport {
  std::uint32_t duplicate_vertices = 0;        // Same position bits: one vertex.
  std::uint32_t unreferenced_vertices = 0;     // In no triangle: dropped.
  std::uint32_t degenerate_triangles = 0;      // Two corners in one place, or on a line: dropped.
  std::uint32_t duplicate_triangles = 0;       // Same three vertices: dropped.
  std::uint32_t flipped_triangles = 0;         // Against most of their component: turned round.
  TopologyRepairs topology;                    // Cut open, see half_edges.h.
  std::vector<std::uint32_t> vertex_of_input;  // kNoHalfEdge: dropped.
  // One line, "" when nothing was wrong.
  std::string text() const;
};

// Facts about a surface in good order.
struct SurfaceFacts {
  std::uint32_t vertices = 0, triangles = 0, components = 0, border_loops = 0, border_edges = 0;
  std::int64_t euler = 0;  // V - E + F
  double volume = 0;       // Sum (x0 x x1).x2 / 6; of a closed surface, what it encloses.
  double border_length = 0;
  double diagonal = 0;  // Of the bounding box.
};

// The result satisfies the contract of collapse_edges(). O(n log n).
Surface repair_surface(Surface surface, RepairReport* report);
SurfaceFacts facts_of(const Surface& surface);

}  // namespace caryatid::bake
