#pragma once
// FAP interpolation by MPEG-4's FIT (ISO/IEC 14496-1): rational polynomials compute what a stream
// leaves out. The rules are data: pack::FitRule, from the pack of the person that is shown, or
// those built in here. caryatid-tool fit writes and reads them as text.
//
// A rule fires when its receiver is absent and all its senders are present (given, or filled by an
// earlier rule). Several rules for one receiver are alternatives in order of preference. A value
// that is not finite (a denominator of 0) is not set.
#include <span>

#include "core/face/fap.h"
#include "core/pack/pack.h"

namespace caryatid::face {

using pack::FitRule;
using pack::FitTerm;

// The rules for streams of other tools, in this order:
//  1. a side from the other side, unchanged: positive directions mirror (14496-2 annex C; the eyes'
//     yaw goes left on both sides and is copied unchanged too, so that they look the same way);
//  2. an outer lip FAP from the inner one of the same place and back (FAP n and n + 47);
//  3. a quarter point of a lip from its middle and corner: 4/5 middle + 1/5 corner; from the middle
//     alone: 4/5 of it;
//  4. a lip's middle from its two quarter points: their mean;
//  5. the middle of a brow from its ends: their mean; from one end: half of it.
std::span<const FitRule> default_fit();

// The rules of a pack (pack::View::fit, validated with it), or the default ones where it has none.
inline std::span<const FitRule> fit_or_default(std::span<const FitRule> of_pack) {
  return of_pack.empty() ? default_fit() : of_pack;
}

// Applies the rules in order, again until none fires, and sets the mask of every FAP they give.
// FAPs 1 and 2 and FAPs that the frame has are never touched. Returns the FAPs that were filled.
// O(rules), a few passes.
BitSet<kFapCount + 1> apply_fit(std::span<const FitRule> rules, FapFrame* io_frame);

}  // namespace caryatid::face
