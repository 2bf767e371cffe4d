#pragma once
// The second goal of simplification: not a number of triangles, but how far the surface may move.
#include <functional>

#include "assets/bake/simplify/history.h"

namespace caryatid::bake {

// The coarsest level of the history, of at least `least` faces, whose distance to the original,
// measured both ways at 10 samples a face and all vertices, keeps within `bound` (units of the
// mesh). With both goals the one that is reached first stops. `watch`, if given, is told the faces
// of each level that is measured. O(log faces) measurements on usual meshes: error grows with
// coarseness but for small ripples, so bisection, then upwards until it holds.
Surface coarsest_within(const History& history, const Surface& original, double bound,
                        std::uint32_t least,
                        const std::function<void(std::uint32_t faces)>& watch = {});

}  // namespace caryatid::bake
