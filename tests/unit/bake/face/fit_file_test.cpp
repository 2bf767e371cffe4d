// Rules of FAP interpolation as text.
#include "assets/bake/face/fit_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "core/face/fit.h"

namespace caryatid::bake {
namespace {

using pack::FitRule;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::string& text) {
  try {
    (void)parse_fit(text, "R");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

void expect_same(std::span<const FitRule> a, std::span<const FitRule> b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof(FitRule)), 0) << i;
}

TEST(FitFile, TheBuiltInRulesComeBackFromTheirText) {
  expect_same(parse_fit(fit_text(face::default_fit()), "R"), face::default_fit());
}

TEST(FitFile, EveryFormComesBackFromItsText) {
  const auto rules = parse_fit(
      "# all forms\n\nF8 = 0.8 F4 - 0.2 F12  # a sum\nF41 = -0.002 F12^2 + F6 F59^3\n"
      "F14 = 120 F3 / 300 + F3\nF7=F6\n",
      "R");
  ASSERT_EQ(rules.size(), 4u);
  EXPECT_EQ(rules[0].numerator[1].coefficient, -0.2f);
  EXPECT_EQ(rules[1].numerator[1].power[1], 3);
  EXPECT_EQ(rules[2].denominator_count, 2);
  expect_same(parse_fit(fit_text(rules), "R"), rules);
}

TEST(FitFile, EachFaultHasItsLine) {
  EXPECT_THAT(refusal(""), HasSubstr("R:1: no rule in it"));
  EXPECT_THAT(refusal("\n# c\nhello\n"), StartsWith("R:3: expected a FAP"));
  EXPECT_THAT(refusal("F2 = F6"), HasSubstr("no FAP 2 to interpolate"));
  EXPECT_THAT(refusal("F7 = F69"), HasSubstr("no FAP 69"));
  EXPECT_THAT(refusal("F7 F6"), HasSubstr("expected ="));
  EXPECT_THAT(refusal("F7 = F7"), HasSubstr("from itself"));
  EXPECT_THAT(refusal("F7 = 3"), HasSubstr("no FAP gives the value"));
  EXPECT_THAT(refusal("F7 = F6^4"), HasSubstr("a power is 1, 2 or 3"));
  EXPECT_THAT(refusal("F7 = F3 F4 F5"), HasSubstr("at most two FAPs"));
  EXPECT_THAT(refusal("F7 = F3 + F4 + F5 + F6 + F8"), HasSubstr("at most 4 terms"));
  EXPECT_THAT(refusal("F7 = F3 / F4 + F5 + F6"), HasSubstr("at most 2 terms"));
  EXPECT_THAT(refusal("F7 = 1e99 F6"), HasSubstr("too large"));
  EXPECT_THAT(refusal("F7 = nan F6"), HasSubstr("expected a term"));
  EXPECT_THAT(refusal("F7 = F6 / F3 / F4"), HasSubstr("more stands on the line"));
  EXPECT_THAT(refusal("F7 = F6 +"), HasSubstr("expected a term"));
  std::string many;
  for (int i = 0; i < 257; ++i) many += "F7 = F6\n";
  EXPECT_THAT(refusal(many), StartsWith("R:257: more than 256 rules"));
}

}  // namespace
}  // namespace caryatid::bake
