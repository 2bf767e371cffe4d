#pragma once
// FAP interpolation after the idea of MPEG-4's FIT node (14496-1: an edge from sending to receiving
// FAPs computes what a stream leaves out), kept to sums: a rule is data, a list of rules is a
// graph.
//
// A rule fires when its receiver is absent and all its senders are present (given, or filled by an
// earlier rule). Several rules for one receiver are alternatives in order of preference.
// Values keep the FAPs' own units and directions; coefficients convert between them.
#include <cstdint>
#include <span>

#include "core/face/fap.h"

namespace caryatid::face {

inline constexpr int kMaxFitTerms = 3;

struct FitTerm {
  std::uint8_t fap = 0;  // Sender; 0 ends the list.
  float coefficient = 0.0f;
};

struct FitRule {
  std::uint8_t receiver = 0;  // 3..68.
  FitTerm term[kMaxFitTerms];
};

// The rules for streams of other tools, in this order:
//  1. a side from the other side, unchanged: positive directions mirror (14496-2 annex C; the eyes'
//     yaw goes left on both sides and is copied unchanged too, so that they look the same way);
//  2. an outer lip FAP from the inner one of the same place and back (FAP n and n + 47);
//  3. a quarter point of a lip from its middle and corner: 4/5 middle + 1/5 corner; from the middle
//     alone: 4/5 of it;
//  4. a lip's middle from its two quarter points: their mean;
//  5. the middle of a brow from its ends: their mean; from one end: half of it.
std::span<const FitRule> default_fit();

// Applies the rules in order, again until none fires, and sets the mask of every FAP they give.
// FAPs 1 and 2 and FAPs that the frame has are never touched. Returns the FAPs that were filled.
// O(rules), a few passes.
BitSet<kFapCount + 1> apply_fit(std::span<const FitRule> rules, FapFrame* io_frame);

}  // namespace caryatid::face
