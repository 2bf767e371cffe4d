#pragma once
// Error over faces of the simplifier beside its peers, from what caryatid-bench measured.
#include <string>

#include "assets/bake/plot/chart.h"

namespace caryatid::bake {

// `text`: JSON of `caryatid-bench --filter simplify --json FILE`. A panel a mesh: mean distance of
// both directions (thick) and Hausdorff distance (thin) in parts of the bounding box's diagonal,
// against the share of the faces that is left, both logarithmic; a colour a method.
// Throws std::runtime_error "FILE:1: what; cure" on anything else.
Chart error_chart(const std::string& text, const std::string& file);

}  // namespace caryatid::bake
