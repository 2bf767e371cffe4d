#pragma once
// Fills FAPs that a frame leaves out from those it has, after the idea of MPEG-4's face
// interpolation table (FIT): left from right, outer lip from inner, quarter points from middle and
// corner. Rules are data, tried in order until none applies; a FAP that is present is never
// changed.
#include "core/face/fap.h"

namespace caryatid::face {

// At most a few hundred steps; no allocation.
void fill_missing(FapFrame& frame);

}  // namespace caryatid::face
