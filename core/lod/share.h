#pragma once
// Shares a budget of triangles among the objects of a scene.
#include <cstdint>
#include <span>

#include "core/lod/frame.h"

namespace caryatid::lod {

// How much an object's coarseness is seen: its area, its place and what it is expressing.
float weight_of(const ObjectNeed& need);

// Spends budget_us so that the sum of weighted screen errors is least. The error of a simplified
// smooth surface falls as 1 / triangles (deviation goes with the square of the edge length; Garland
// and Heckbert 1999 show it for quadric error), so with cost t by triangle the optimum has
// n = lambda * sqrt(weight / t), clamped to the object's minimum and maximum.
//
// triangle_us: cost of one triangle of each object, > 0, as long as objects.
// out: targets, as long as objects. Returns their cost in microseconds, which exceeds budget_us
// only where all minima together do. Finds lambda by 24 bisections: O(24 objects).
float share_budget(std::span<const ObjectNeed> objects, std::span<const float> triangle_us,
                   float budget_us, std::span<std::uint32_t> out);

}  // namespace caryatid::lod
