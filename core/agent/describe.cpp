#include "core/agent/describe.h"

namespace caryatid::agent {
namespace {

// "5: ", from the digits that every language has; other badges than numbers are left out.
void append_badge(const Programme& programme, std::string_view badge, std::uint16_t language,
                  Utterable* out) {
  bool any = false;
  for (const char c : badge) {
    if (c < '0' || c > '9') continue;
    append_value(programme, language, kDigitValues + static_cast<std::size_t>(c - '0'), out);
    any = true;
  }
  if (any) append_value(programme, language, kColonValue, out);
  if (any) append_blank(out);
}

}  // namespace

void describe(const Programme& programme, const Guidance& shown, const Moment& now,
              Utterable* out) {
  out->clear();
  const auto add = [&](std::uint16_t text) {
    const Line* line = programme.line(text, shown.language);
    if (line == nullptr) return;
    begin_part(out);
    append(programme, *line, now, out);
  };
  const Page& page = programme.pages[shown.page];
  out->language = shown.language;
  add(page.title);
  add(page.body);
  if (shown.picture < programme.pictures.size()) add(programme.pictures[shown.picture].alternative);
  for (const Choice& c : programme.choices.subspan(page.first_choice, page.choice_count)) {
    const Line* label = programme.line(c.label, shown.language);
    if (label == nullptr) continue;
    begin_part(out);
    append_badge(programme, programme.text(programme.buttons[c.button - 1u].badge), shown.language,
                 out);
    append(programme, *label, now, out);
  }
}

}  // namespace caryatid::agent
