#include "core/face/fit.h"

#include <array>
#include <cmath>

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

struct Share {
  std::uint8_t fap = 0;
  float coefficient = 0.0f;
};
constexpr FitTerm linear(Share s) { return {s.coefficient, {s.fap, 0}, {1, 0}}; }

struct RuleList {
  std::array<FitRule, kRuleCount> rule{};
  std::size_t count = 0;
  constexpr void add(int receiver, Share a, Share b = {}) {
    FitRule& r = rule[count++];
    r.receiver = static_cast<std::uint8_t>(receiver);
    r.numerator_count = b.fap != 0 ? 2 : 1;
    r.numerator[0] = linear(a);
    if (b.fap != 0) r.numerator[1] = linear(b);
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
    const Share middle{at(kInnerMiddle[i]), kMiddleShare};
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

bool has_senders(std::span<const FitTerm> terms, const FapFrame& frame) {
  for (const FitTerm& term : terms)
    for (const std::uint8_t fap : term.fap)
      if (fap != 0 && !frame.mask.test(fap)) return false;
  return true;
}

float sum_of(std::span<const FitTerm> terms, const FapFrame& frame) {
  float sum = 0.0f;
  for (const FitTerm& term : terms) {
    float product = term.coefficient;
    for (std::size_t i = 0; i < pack::kFitFactors; ++i)
      for (int p = 0; p < term.power[i]; ++p) product *= frame.value[term.fap[i]];
    sum += product;
  }
  return sum;
}

bool apply(const FitRule& rule, FapFrame* io_frame) {
  const std::span numerator(rule.numerator, rule.numerator_count);
  const std::span denominator(rule.denominator, rule.denominator_count);
  if (io_frame->mask.test(rule.receiver) || !has_senders(numerator, *io_frame) ||
      !has_senders(denominator, *io_frame))
    return false;
  float value = sum_of(numerator, *io_frame);
  if (!denominator.empty()) value /= sum_of(denominator, *io_frame);
  if (!std::isfinite(value)) return false;
  io_frame->set(rule.receiver, value);
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
      if (!apply(rule, io_frame)) continue;
      filled.set(rule.receiver);
      changed = true;
    }
  }
  return filled;
}

}  // namespace caryatid::face
