#pragma once
// Completes frames of other tools: files and streams often carry one side of the face, or only the
// outer or only the inner lips, and leave it to the player to move the rest along.
#include "core/face/fit.h"

namespace caryatid::face {

// Fills FAPs that the frame leaves out from their partners by the rules of a FIT (by default left
// and right, inner and outer lips, quarter points of the lips). FAPs without a present partner stay
// absent.
//
// Lips: some tools flag all lip FAPs but write zeros for the set that they do not know (Xface's
// reader mends these too). When every present FAP of one set (inner 4..13, outer 51..60) is 0 and
// the other set moves, the still set counts as left out.
// Returns the FAPs that were filled. FAPs 1 and 2 are never touched. O(1), a few hundred steps.
BitSet<kFapCount + 1> fill_from_partners(FapFrame* io_frame,
                                         std::span<const FitRule> rules = default_fit());

// Limits every FAP to +-coding_limit (fap_table.h), the range that the standard's streams carry.
// Values from outside pass through here before they reach a face. Not-a-number becomes 0.
void limit_to_coding_range(FapFrame* io_frame);

}  // namespace caryatid::face
