#pragma once
// Numbers off the command line: whole words, finite, in range, or wrong usage.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace caryatid::tool {

// The number that `text` is as a whole; none for anything else, "nan" and "inf" included.
inline std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || at != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// As finite_number(), within low..high.
inline std::optional<double> number_within(std::string_view text, double low, double high) {
  const std::optional<double> value = finite_number(text);
  return value && *value >= low && *value <= high ? value : std::nullopt;
}

// For CLI::Option::check(). CLI::Range lets NaN through.
inline CLI::Validator number_from(double low, double high) {
  char range[80];
  std::snprintf(range, sizeof range, "%.10g to %.10g", low, high);
  return {[low, high, words = std::string(range)](std::string& text) -> std::string {
            if (number_within(text, low, high)) return {};
            return "'" + text + "' is no number from " + words;
          },
          std::string(range), "number"};
}

}  // namespace caryatid::tool
