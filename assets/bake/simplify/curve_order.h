#pragma once
// Numbers along a space-filling curve: what lies together in space lies together in memory, so that
// the time of large meshes does not go into waiting for memory; and the numbers no longer depend on
// the order of a file.
#include <cstdint>
#include <span>
#include <vector>

#include "assets/bake/simplify/vec3d.h"

namespace caryatid::bake {

// The points in order of the Morton curve over 1024 cells a side of their box; those in one cell by
// their number. O(n log n).
std::vector<std::uint32_t> curve_order(std::span<const Vec3d> points);

}  // namespace caryatid::bake
