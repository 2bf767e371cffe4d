#include "core/face/fap_fill.h"

#include <algorithm>

#include "core/face/fap_table.h"

namespace caryatid::face {
namespace {

struct LipSet {
  int first;
  int last;
};
constexpr LipSet kInnerLips = {4, 13};
constexpr LipSet kOuterLips = {51, 60};

bool moves(const FapFrame& frame, LipSet lips) {
  for (int fap = lips.first; fap <= lips.last; ++fap)
    if (frame.has(fap) && frame.get(fap) != 0.0f) return true;
  return false;
}

void leave_out(LipSet lips, FapFrame* io_frame) {
  for (int fap = lips.first; fap <= lips.last; ++fap)
    io_frame->mask.set(static_cast<std::size_t>(fap), false);
}

}  // namespace

BitSet<kFapCount + 1> fill_from_partners(FapFrame* io_frame, std::span<const FitRule> rules) {
  const bool inner = moves(*io_frame, kInnerLips);
  const bool outer = moves(*io_frame, kOuterLips);
  if (inner != outer) leave_out(inner ? kOuterLips : kInnerLips, io_frame);
  return apply_fit(rules, io_frame);
}

void limit_to_coding_range(FapFrame* io_frame) {
  for (int fap = kFapExpression + 1; fap <= kFapCount; ++fap) {
    const float limit = coding_limit(fap_info(fap));
    float& value = io_frame->value[static_cast<std::size_t>(fap)];
    value = value == value ? std::clamp(value, -limit, limit) : 0.0f;
  }
}

}  // namespace caryatid::face
