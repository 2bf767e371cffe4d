#include "core/agent/ssml.h"

#include <algorithm>

#include "core/body/gesture.h"

namespace caryatid::agent {
namespace {

constexpr std::size_t kClosing = 64;  // Bytes for the ends of all elements that can be open.

struct Number {
  std::array<char, 10> digits{};
  std::size_t begin = 10;
  explicit Number(std::uint32_t n) {
    do {
      digits[--begin] = static_cast<char>('0' + n % 10);
      n /= 10;
    } while (n != 0);
  }
  std::string_view text() const { return {digits.data() + begin, digits.size() - begin}; }
};

std::string_view escape_of(char c) {
  if (c == '&') return "&amp;";
  if (c == '<') return "&lt;";
  return c == '>' ? "&gt;" : "";
}

}  // namespace

void Ssml::put(std::string_view piece) {
  if (text_.size() + piece.size() > text_.capacity()) return;
  for (const char c : piece) (void)text_.push(c);
}

void Ssml::anchor(std::size_t plain_at) {
  (void)anchors_.push(
      {static_cast<std::uint32_t>(text_.size()), static_cast<std::uint32_t>(plain_at)});
}

void Ssml::put_cue(const Programme& programme, const Cue& cue) {
  switch (cue.kind) {
    case CueKind::pause:
      put("<break time=\"");
      put(Number(cue.value).text());
      put("ms\"/>");
      break;
    case CueKind::gesture:
      put("<mark name=\"");
      put(body::gesture_name(static_cast<body::GestureKind>(cue.value)));
      put("\"/>");
      break;
    case CueKind::emphasis:
      if (emphasis_ != (cue.value != 0)) put(emphasis_ ? "</emphasis>" : "<emphasis>");
      emphasis_ = cue.value != 0;
      break;
    case CueKind::language:
      if (language_) put("</lang>");
      language_ = true;
      put("<lang xml:lang=\"");
      put(programme.text(programme.languages[cue.value].voice));
      put("\">");
      break;
    case CueKind::spell:
      if (spell_ != (cue.value != 0))
        put(spell_ ? "</say-as>" : "<say-as interpret-as=\"characters\">");
      spell_ = cue.value != 0;
      break;
    case CueKind::mark:
      break;
  }
}

void Ssml::write(const Programme& programme, const Utterable& text) {
  text_.clear();
  anchors_.clear();
  emphasis_ = language_ = spell_ = false;
  put("<speak>");
  anchor(0);
  std::size_t cue = 0;
  for (std::size_t i = 0; i <= text.text.size(); ++i) {
    for (; cue < text.cues.size() && text.cues[cue].at <= i; ++cue) {
      if (text_.size() + 2 * kClosing < text_.capacity()) put_cue(programme, text.cues[cue]);
      anchor(i);
    }
    if (i == text.text.size() || text_.size() + kClosing > text_.capacity()) break;
    const std::string_view escape = escape_of(text.text[i]);
    if (escape.empty()) {
      (void)text_.push(text.text[i]);
      continue;
    }
    put(escape);
    anchor(i + 1);
  }
  if (spell_) put("</say-as>");
  if (emphasis_) put("</emphasis>");
  if (language_) put("</lang>");
  put("</speak>");
}

std::uint32_t Ssml::plain_byte(std::uint32_t ssml_byte) const {
  const auto* after =
      std::upper_bound(anchors_.begin(), anchors_.end(), ssml_byte,
                       [](std::uint32_t byte, const Anchor& anchor) { return byte < anchor.ssml; });
  if (after == anchors_.begin()) return 0;
  const Anchor& at = *(after - 1);
  const std::uint32_t plain = at.plain + (ssml_byte - at.ssml);
  return after == anchors_.end() ? plain : std::min(plain, after->plain);
}

}  // namespace caryatid::agent
