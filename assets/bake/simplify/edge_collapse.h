#pragma once
// Memoryless edge collapse of plain surfaces (Lindstrom & Turk 1998, 1999; thesis chapter 2): the
// shape alone, fast. Objects with attributes go through object_history.h.
#include <array>
#include <cstdint>
#include <vector>

#include "assets/bake/simplify/half_edges.h"
#include "assets/bake/simplify/vec3d.h"

namespace caryatid::bake {

using Triangle = std::array<std::uint32_t, 3>;

// A triangle mesh of positions. Triangles are counter-clockwise seen from outside.
struct Surface {
  std::vector<Vec3d> position;
  std::vector<Triangle> triangles;
};

// One collapse, with all that undoing it takes.
struct CollapseRecord {
  std::uint32_t keep = 0, gone = 0;  // Vertices of the input surface.
  Vec3d old_keep{0}, old_gone{0};    // Where they stood before; then keep stands at `x`.
  Vec3d x{0};
  std::uint32_t triangle_count = 0;                // Removed: 1 at a border, else 2.
  std::array<std::uint32_t, 2> triangle{};         // Numbers in the input surface,
  std::array<Triangle, 2> corners{};               // and their corners just before.
  std::uint32_t first_moved = 0, moved_count = 0;  // Into CollapseLog::moved.
};
struct CollapseLog {
  std::vector<CollapseRecord> records;
  std::vector<std::uint32_t> moved;  // 3 * triangle + corner where `gone` became `keep`.
};

struct CollapseOptions {
  std::uint32_t target_triangles = 4;
  std::vector<std::uint32_t> locked;  // Vertices that stay where they are.
  CollapseLog* log = nullptr;         // Takes the history when not null.
};

struct CollapseReport {
  std::uint32_t collapses = 0, rejected = 0;
  TopologyRepairs repairs;
};

// Simplifies until the target is reached or nothing valid is left. Deterministic, and free of the
// numbering of the input but for vertices in one thousandth of the box. At most 67 bytes a triangle
// at its peak, the surface included; O(n log n).
//
// What bounds the speed (perf, body of 26756 triangles, 2 us a collapse): 45 % is the evaluation of
// some 25 edges a collapse (a third arithmetic, two thirds gathering quadrics), 15 % the exact
// position in double, 15 % connectivity, 10 % the queue, 15 % building the half-edges. Above 100000
// triangles waiting for memory doubles the time a collapse.
//
// Contract: finite positions; no triangle names a vertex twice or one that is not there.
// Vertices are renumbered along a space-filling curve (unused ones drop out). With a log, what
// stays keeps the order of the input, ids in it are those of the input, and fans cut off a
// non-manifold vertex follow after position.size().
Surface collapse_edges(Surface surface, const CollapseOptions& options,
                       CollapseReport* report = nullptr);

}  // namespace caryatid::bake
