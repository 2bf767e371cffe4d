#include "firmware-app/command.h"

#include <algorithm>
#include <array>

namespace caryatid::app {
namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Cuts the first word off `rest`.
std::string_view take_word(std::string_view* rest) {
  *rest = trimmed(*rest);
  const std::size_t end = std::min(rest->find_first_of(kBlanks), rest->size());
  const std::string_view word = rest->substr(0, end);
  *rest = trimmed(rest->substr(end));
  return word;
}

// 0, 1, or 0.d with up to four digits: all that a strength needs, with no locale in it.
bool strength_of(std::string_view text, float* out) {
  if (text.empty() || text.size() > 6 || (text[0] != '0' && text[0] != '1')) return false;
  float value = text[0] == '1' ? 1.0f : 0.0f;
  if (text.size() > 1 && text[1] != '.') return false;
  float place = 0.1f;
  for (std::size_t i = 2; i < text.size(); ++i, place *= 0.1f) {
    if (text[i] < '0' || text[i] > '9') return false;
    value += place * static_cast<float>(text[i] - '0');
  }
  *out = value;
  return value <= 1.0f;
}

Command wrong(std::string_view why) {
  Command c;
  c.text = why;
  return c;
}

Command feel(std::string_view rest) {
  const std::string_view name = take_word(&rest);
  const auto& names = emotion::kEmotionNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    return wrong("feel what? one of calm, joy, sadness, anger, fear, disgust, surprise");
  Command c;
  c.kind = CommandKind::feel;
  c.emotion = static_cast<emotion::Emotion>(found - names.begin());
  if (!rest.empty() && !strength_of(rest, &c.strength))
    return wrong("the strength is a number from 0 to 1, as in: feel joy 0.7");
  return c;
}

}  // namespace

Command parse_command(std::string_view line) {
  struct Verb {
    std::string_view name;
    CommandKind kind;
    bool needs_text;
  };
  constexpr std::array<Verb, 6> kVerbs = {{{"press", CommandKind::press, true},
                                           {"release", CommandKind::release, true},
                                           {"say", CommandKind::say, true},
                                           {"play", CommandKind::play, false},
                                           {"status", CommandKind::status, false},
                                           {"help", CommandKind::help, false}}};
  std::string_view rest = line;
  const std::string_view verb = take_word(&rest);
  if (verb == "feel") return feel(rest);
  for (const Verb& v : kVerbs) {
    if (v.name != verb) continue;
    if (v.needs_text && rest.empty()) return wrong("a word is missing behind it; see help");
    Command c;
    c.kind = v.kind;
    c.text = rest;
    return c;
  }
  return wrong("no such command; see help");
}

}  // namespace caryatid::app
