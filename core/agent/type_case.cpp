#include "core/agent/type_case.h"

#include <algorithm>

namespace caryatid::agent {
namespace {

// A run of more letters than any word: an address, a script without blanks.
constexpr std::size_t kMostLetters = 32;

// The code point at `*io_at`, which is moved behind it; the text is valid UTF-8 or cut short.
char32_t next_code(std::string_view text, std::size_t* io_at) {
  const auto first = static_cast<unsigned char>(text[(*io_at)++]);
  if (first < 0x80) return first;
  const std::size_t more = first >= 0xF0 ? 3 : (first >= 0xE0 ? 2 : 1);
  char32_t code = first & (0x3Fu >> more);
  for (std::size_t i = 0; i < more && *io_at < text.size(); ++i)
    code = code << 6u | (static_cast<unsigned char>(text[(*io_at)++]) & 0x3Fu);
  return code;
}

// Hebrew, Arabic and their kin, and their presentation forms.
bool leftward(char32_t code) {
  return (code >= 0x0590 && code < 0x0900) || (code >= 0xFB1D && code < 0xFE00) ||
         (code >= 0xFE70 && code < 0xFF00);
}

// A blank between two words that run leftwards goes with them.
void join_blank(scene::Runs* io) {
  const std::size_t n = io->size();
  if (n >= 2 && (*io)[n - 1].blank && (*io)[n - 2].level == 1) (*io)[n - 1].level = 1;
}

}  // namespace

const TypeLetter* TypeCase::find(char32_t code) const {
  const auto at = std::lower_bound(letters_.begin(), letters_.end(), code,
                                   [](const TypeLetter& l, char32_t c) { return l.code < c; });
  return at != letters_.end() && at->code == code ? &*at : nullptr;
}

std::uint32_t TypeCase::set(std::string_view text, std::uint32_t from, Utterable* out) const {
  out->clear();
  const std::string_view rest = text.substr(std::min<std::size_t>(from, text.size()));
  auto& glyphs = out->value_glyphs_;
  std::size_t at = 0;
  while (at < rest.size()) {
    // One word, or the blanks between two.
    const std::size_t begin = at, first = glyphs.size();
    const bool blank = rest[at] == ' ';
    scene::Run run;
    run.blank = run.break_after = blank;
    bool fits = true;
    std::size_t letters = 0;
    while (at < rest.size() && (rest[at] == ' ') == blank && letters++ < kMostLetters) {
      const char32_t code = next_code(rest, &at);
      if (leftward(code)) run.level = 1;
      const TypeLetter* letter = find(code);
      if (letter == nullptr) continue;
      fits = fits && glyphs.push({letter->glyph, letter->advance, 0, 0});
      run.width += letter->advance;
    }
    run.break_after = blank || letters > kMostLetters;
    for (std::size_t i = begin; fits && i < at; ++i) fits = out->text.push(rest[i]);
    if (run.level == 1) std::reverse(glyphs.begin() + first, glyphs.end());
    run.glyphs = glyphs.span().subspan(first);
    run.text_begin = static_cast<std::uint16_t>(begin);
    run.text_end = static_cast<std::uint16_t>(at);
    if (fits && run.level == 1) join_blank(&out->runs);
    if (fits && out->runs.push(run)) continue;
    at = begin;
    break;
  }
  return from + static_cast<std::uint32_t>(at);
}

}  // namespace caryatid::agent
