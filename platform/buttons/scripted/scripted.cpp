#include "platform/buttons/scripted/scripted.h"

#include <charconv>

namespace caryatid::platform {
namespace {

std::string_view next_word(std::string_view* line) {
  const std::size_t begin = std::min(line->find_first_not_of(" \t\r"), line->size());
  line->remove_prefix(begin);
  const std::size_t end = std::min(line->find_first_of(" \t\r"), line->size());
  const std::string_view word = line->substr(0, end);
  line->remove_prefix(end);
  return word;
}

}  // namespace

bool ScriptedButtons::split(std::string_view line, Line* out, const char** out_reason) {
  line = line.substr(0, line.find('#'));
  const std::string_view time = next_word(&line), name = next_word(&line), edge = next_word(&line);
  if (time.empty()) return true;
  double seconds = 0.0;
  const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), seconds);
  *out_reason = "time is not a number of seconds; write SECONDS NAME down|up";
  if (error != std::errc{} || end != time.data() + time.size() ||
      !(seconds >= 0.0 && seconds < 1e9))
    return false;
  *out_reason = "wanted 'down' or 'up' at the end; write SECONDS NAME down|up";
  if (name.empty() || (edge != "down" && edge != "up") || !next_word(&line).empty()) return false;
  *out = {static_cast<std::int64_t>(seconds * 1e6 + 0.5), name, edge == "down"};
  return true;
}

bool ScriptedButtons::refuse(std::string_view file, std::size_t line, const std::string& reason,
                             std::string* out_error) {
  *out_error = std::string(file) + ":" + std::to_string(line) + ": " + reason;
  events_.clear();
  return false;
}

Status ScriptedButtons::poll(std::int64_t now_us, ButtonEvents& out) {
  while (next_ < events_.size() && events_[next_].time_us <= now_us)
    if (!out.push(events_[next_++])) break;
  return {};
}

}  // namespace caryatid::platform
