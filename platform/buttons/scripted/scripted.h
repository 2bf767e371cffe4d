#pragma once
// Recorded button events, one a line: SECONDS NAME down|up   ('#' starts a comment).
#include <string>
#include <string_view>
#include <vector>

#include "platform/buttons/buttons.h"

namespace caryatid::platform {

class ScriptedButtons final : public Buttons {
 public:
  // number_of tells the button (from 1) of a name, 0 when there is none. False: `out_error` is one
  // line "FILE:LINE: what; cure". Reads the whole text, so nothing allocates later.
  template <class NumberOf>
  bool parse(std::string_view text, std::string_view file, NumberOf number_of,
             std::string* out_error);

  // Appends the events whose time has come; `now_us` counts from the start of the run.
  Status poll(std::int64_t now_us, ButtonEvents& out) override;

 private:
  struct Line {
    std::int64_t time_us;
    std::string_view name;
    bool pressed;
  };
  // Splits one line; false with a reason. A comment or blank line leaves `name` empty.
  static bool split(std::string_view line, Line* out, const char** out_reason);
  bool refuse(std::string_view file, std::size_t line, const std::string& reason,
              std::string* out_error);

  std::vector<ButtonEvent> events_;
  std::size_t next_ = 0;
};

template <class NumberOf>
bool ScriptedButtons::parse(std::string_view text, std::string_view file, NumberOf number_of,
                            std::string* out_error) {
  events_.clear();
  next_ = 0;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Line line{0, {}, false};
    const char* reason = "";
    if (!split(text.substr(0, end), &line, &reason))
      return refuse(file, line_number, reason, out_error);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.name.empty()) continue;
    const int number = number_of(line.name);
    if (number <= 0)
      return refuse(file, line_number,
                    "no button '" + std::string(line.name) + "'; name one of the kiosk.toml",
                    out_error);
    if (!events_.empty() && line.time_us < events_.back().time_us)
      return refuse(file, line_number, "earlier than the line before; sort the lines by time",
                    out_error);
    events_.push_back({static_cast<std::uint16_t>(number), line.pressed, line.time_us});
  }
  return true;
}

}  // namespace caryatid::platform
