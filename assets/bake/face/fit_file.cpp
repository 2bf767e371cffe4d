#include "assets/bake/face/fit_file.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace caryatid::bake {
namespace {

constexpr int kFirstFap = 3, kLastFap = 68, kMostPower = 3;

// One line of the text, word by word.
class Line {
 public:
  Line(std::string text, std::string where) : text_(std::move(text)), where_(std::move(where)) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(where_ + ": " + what);
  }
  bool done() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ >= text_.size();
  }
  bool take(char c) {
    if (done() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool is_fap() { return !done() && text_[at_] == 'F'; }

  std::uint8_t fap() {
    if (!take('F')) refuse("expected a FAP as F3..F68");
    const int n = whole();
    if (n < kFirstFap || n > kLastFap)
      refuse("there is no FAP " + std::to_string(n) + " to interpolate; F3..F68");
    return static_cast<std::uint8_t>(n);
  }
  std::uint8_t power() {
    if (!take('^')) return 1;
    const int n = whole();
    if (n < 1 || n > kMostPower) refuse("a power is 1, 2 or 3");
    return static_cast<std::uint8_t>(n);
  }
  // False where no number stands.
  bool number(float* out) {
    if (done()) return false;
    const char* end = text_.data() + text_.size();
    const auto [rest, error] = std::from_chars(text_.data() + at_, end, *out);
    if (error == std::errc::result_out_of_range) refuse("the number is too large");
    if (error != std::errc{} || !std::isfinite(*out)) return false;
    at_ = static_cast<std::size_t>(rest - text_.data());
    return true;
  }

 private:
  int whole() {
    int n = 0;
    const char* end = text_.data() + text_.size();
    const auto [rest, error] = std::from_chars(text_.data() + at_, end, n);
    if (error != std::errc{}) refuse("expected a whole number");
    at_ = static_cast<std::size_t>(rest - text_.data());
    return n;
  }

  std::string text_, where_;
  std::size_t at_ = 0;
};

pack::FitTerm term_of(Line& line, float sign, std::uint8_t receiver) {
  pack::FitTerm term{};
  float coefficient = 1.0f;
  const bool has_number = line.number(&coefficient);
  term.coefficient = sign * coefficient;
  std::size_t factors = 0;
  for (; line.is_fap(); ++factors) {
    if (factors == pack::kFitFactors) line.refuse("a term has at most two FAPs");
    term.fap[factors] = line.fap();
    term.power[factors] = line.power();
    if (term.fap[factors] == receiver) line.refuse("a FAP can't be computed from itself");
  }
  if (!has_number && factors == 0) line.refuse("expected a term: a number, FAPs, or both");
  return term;
}

// Terms up to `/` or the end; their number.
std::uint8_t sum_of(Line& line, std::uint8_t receiver, std::span<pack::FitTerm> out) {
  std::size_t count = 0;
  float sign = line.take('-') ? -1.0f : 1.0f;
  for (;;) {
    if (count == out.size())
      line.refuse("at most " + std::to_string(out.size()) + " terms can stand here");
    out[count++] = term_of(line, sign, receiver);
    if (line.take('+'))
      sign = 1.0f;
    else if (line.take('-'))
      sign = -1.0f;
    else
      return static_cast<std::uint8_t>(count);
  }
}

pack::FitRule rule_of(Line& line) {
  pack::FitRule rule{};
  rule.receiver = line.fap();
  if (!line.take('=')) line.refuse("expected = after the FAP that the rule gives");
  rule.numerator_count = sum_of(line, rule.receiver, rule.numerator);
  if (line.take('/')) rule.denominator_count = sum_of(line, rule.receiver, rule.denominator);
  if (!line.done()) line.refuse("more stands on the line; write F4 = 0.5 F8 + 0.5 F9");
  bool names_fap = false;
  for (const pack::FitTerm& term : rule.numerator) names_fap |= term.fap[0] != 0;
  if (!names_fap) line.refuse("no FAP gives the value; name one before the /");
  return rule;
}

std::string sum_text(std::span<const pack::FitTerm> terms) {
  std::string out;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const pack::FitTerm& term = terms[i];
    const bool minus = std::signbit(term.coefficient);
    out += i == 0 ? (minus ? "-" : "") : (minus ? " - " : " + ");
    char number[32];
    const auto end = std::to_chars(number, number + sizeof number, std::abs(term.coefficient)).ptr;
    std::string factors;
    for (std::size_t f = 0; f < pack::kFitFactors; ++f) {
      if (term.fap[f] == 0) continue;
      factors += (factors.empty() ? "F" : " F") + std::to_string(term.fap[f]);
      if (term.power[f] != 1) factors += "^" + std::to_string(term.power[f]);
    }
    if (factors.empty() || std::abs(term.coefficient) != 1.0f) {
      out.append(number, end);
      if (!factors.empty()) out += " ";
    }
    out += factors;
  }
  return out;
}

}  // namespace

std::vector<pack::FitRule> parse_fit(const std::string& text, const std::string& name) {
  std::vector<pack::FitRule> out;
  std::istringstream lines(text);
  std::string words;
  for (int number = 1; std::getline(lines, words); ++number) {
    Line line(words.substr(0, words.find('#')), name + ":" + std::to_string(number));
    if (line.done()) continue;
    if (out.size() == pack::kMaxFitRules)
      line.refuse("more than " + std::to_string(pack::kMaxFitRules) + " rules");
    out.push_back(rule_of(line));
  }
  if (out.empty()) throw std::runtime_error(name + ":1: no rule in it; write F7 = F6");
  return out;
}

std::string fit_text(std::span<const pack::FitRule> rules) {
  std::string out;
  for (const pack::FitRule& rule : rules) {
    out += "F" + std::to_string(rule.receiver) + " = " +
           sum_text({rule.numerator, rule.numerator_count});
    if (rule.denominator_count > 0)
      out += " / " + sum_text({rule.denominator, rule.denominator_count});
    out += "\n";
  }
  return out;
}

}  // namespace caryatid::bake
