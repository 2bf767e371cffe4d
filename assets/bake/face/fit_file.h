#pragma once
// FAP interpolation (core/face/fit.h) as text, one rule a line:
//   F8 = 0.8 F4 - 0.2 F12          a sum of terms
//   F41 = 0.002 F12^2 + 0.1 F6 F59 powers (1..3) and products of two FAPs
//   F14 = 120 F3 / 300 + F3        one `/`: the sum before it by the sum after it
// `#` begins a comment. Rules for one receiver stand in order of preference.
#include <span>
#include <string>
#include <vector>

#include "core/pack/pack.h"

namespace caryatid::bake {

// Throws std::runtime_error "NAME:LINE: what is wrong; cure".
std::vector<pack::FitRule> parse_fit(const std::string& text, const std::string& name);

// Reads back as the same rules.
std::string fit_text(std::span<const pack::FitRule> rules);

}  // namespace caryatid::bake
