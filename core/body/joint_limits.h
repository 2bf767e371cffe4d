#pragma once
// Table 4-1 of the thesis: how far joints turn, as an optional layer over any frame of BAPs. MPEG-4
// itself has no limits; streams that exceed these look broken on a human body.
#include "core/body/bap.h"
#include "core/body/bap_axes.h"

namespace caryatid::body {

struct LimitReport {
  int bitten = 0;     // Angles that were outside their range.
  int worst_bap = 0;  // The one that was farthest outside, 0: none.
  float worst_excess_rad = 0.0f;
};

// Bends every limited angle of the frame back into its range, in the given convention:
// inside a range less a margin of 5 degrees nothing changes; beyond, the angle approaches the limit
// without ever passing it, so motion stays smooth. Spine and neck limits hold for the sum over the
// joints of a part, as table 4-1 gives them. Not finite counts as 0. Cost: O(limited BAPs).
LimitReport limit_joints(BapFrame& io_frame, BapConvention convention = BapConvention::signed_axes);

}  // namespace caryatid::body
