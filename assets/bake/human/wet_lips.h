#pragma once
// Lets closed lips touch instead of lying in each other: the package's wet sides overlap by up to
// two millimetres behind the line where they meet.
#include "assets/bake/human/figure.h"

namespace caryatid::bake {

// Moves what overlaps of both lips apart, each by half. The middle of the line of the closed lips
// (feature points 2.2 and 2.3) stays.
void part_wet_lips(const std::vector<FeaturePointPlace>& places, Figure& inout_figure);

}  // namespace caryatid::bake
