#include "core/face/fit.h"

#include <array>

namespace caryatid::face {
namespace {

constexpr int kFirstInnerLip = 4, kLastInnerLip = 13, kInnerToOuter = 47;
// Upper left, upper right, lower left, lower right.
constexpr std::uint8_t kInnerQuarter[4] = {8, 9, 10, 11};
constexpr std::uint8_t kInnerMiddle[4] = {4, 4, 5, 5};
constexpr std::uint8_t kInnerCorner[4] = {12, 13, 12, 13};
// Upper lip FAPs count downwards, corners upwards.
constexpr float kCornerSign[4] = {-1, -1, 1, 1};
// A parted lip is an arc: at half its width an ellipse keeps 0.87 of the height, a parabola 0.75;
// measured lips lie between.
constexpr float kMiddleShare = 0.8f;

// The left FAP of every pair; its right partner is the next number (fap_table.h).
constexpr std::uint8_t kLeft[] = {6,  8,  10, 12, 19, 21, 23, 25, 27, 29, 31, 33,
                                  35, 37, 39, 41, 53, 55, 57, 59, 61, 65, 67};

// Sides both ways, lips both ways, for either contour two rules a quarter and two middles, and
// three rules for each brow's middle.
constexpr std::size_t kRuleCount = 2 * std::size(kLeft) + 2 * 10 + 2 * (2 * 4 + 2) + 2 * 3;

struct RuleList {
  std::array<FitRule, kRuleCount> rule{};
  std::size_t count = 0;
  constexpr void add(int receiver, FitTerm a, FitTerm b = {}) {
    rule[count++] = {static_cast<std::uint8_t>(receiver), {a, b, {}}};
  }
};

constexpr void add_sides(RuleList* list) {
  for (const std::uint8_t left : kLeft) {
    const auto right = static_cast<std::uint8_t>(left + 1);
    list->add(right, {left, 1.0f});
    list->add(left, {right, 1.0f});
  }
}

constexpr void add_lips(RuleList* list) {
  for (int inner = kFirstInnerLip; inner <= kLastInnerLip; ++inner) {
    const int outer = inner + kInnerToOuter;
    list->add(outer, {static_cast<std::uint8_t>(inner), 1.0f});
    list->add(inner, {static_cast<std::uint8_t>(outer), 1.0f});
  }
}

constexpr void add_quarters(RuleList* list, int offset) {
  const auto at = [offset](std::uint8_t fap) { return static_cast<std::uint8_t>(fap + offset); };
  for (int i = 0; i < 4; ++i) {
    const FitTerm middle{at(kInnerMiddle[i]), kMiddleShare};
    list->add(at(kInnerQuarter[i]), middle,
              {at(kInnerCorner[i]), kCornerSign[i] * (1.0f - kMiddleShare)});
    list->add(at(kInnerQuarter[i]), middle);
  }
  for (int i = 0; i < 4; i += 2)
    list->add(at(kInnerMiddle[i]), {at(kInnerQuarter[i]), 0.5f}, {at(kInnerQuarter[i + 1]), 0.5f});
}

// The middle of a brow from its ends.
constexpr void add_brow(RuleList* list, std::uint8_t inner, std::uint8_t middle,
                        std::uint8_t outer) {
  list->add(middle, {inner, 0.5f}, {outer, 0.5f});
  list->add(middle, {inner, 0.5f});
  list->add(middle, {outer, 0.5f});
}

constexpr RuleList make_default() {
  RuleList list;
  add_sides(&list);
  add_lips(&list);
  add_quarters(&list, 0);
  add_quarters(&list, kInnerToOuter);
  add_brow(&list, 31, 33, 35);
  add_brow(&list, 32, 34, 36);
  return list;
}

constexpr RuleList kDefault = make_default();
static_assert(kDefault.count == kRuleCount);

bool fires(const FitRule& rule, const FapFrame& frame) {
  if (rule.term[0].fap == 0 || frame.mask.test(rule.receiver)) return false;
  for (const FitTerm& term : rule.term)
    if (term.fap != 0 && !frame.mask.test(term.fap)) return false;
  return true;
}

}  // namespace

std::span<const FitRule> default_fit() { return {kDefault.rule.data(), kDefault.count}; }

BitSet<kFapCount + 1> apply_fit(std::span<const FitRule> rules, FapFrame* io_frame) {
  BitSet<kFapCount + 1> filled;
  // Every pass fills at least one FAP or is the last; in practice three passes reach everything.
  for (bool changed = true; changed;) {
    changed = false;
    for (const FitRule& rule : rules) {
      if (!fires(rule, *io_frame)) continue;
      float sum = 0.0f;
      for (const FitTerm& term : rule.term)
        if (term.fap != 0) sum += term.coefficient * io_frame->value[term.fap];
      io_frame->set(rule.receiver, sum);
      filled.set(rule.receiver);
      changed = true;
    }
  }
  return filled;
}

}  // namespace caryatid::face
