#pragma once
// Fills FAPs that a frame of our own leaves out from those it has, by the default rules of fit.h: a
// FAP that is present is never changed. (Frames of other tools: fill_from_partners, fap_fill.h.)
#include "core/face/fap.h"

namespace caryatid::face {

// At most a few hundred steps; no allocation.
void fill_missing(FapFrame& frame);

}  // namespace caryatid::face
