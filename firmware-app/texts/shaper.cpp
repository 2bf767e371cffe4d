#include "firmware-app/texts/shaper.h"

#include <fribidi.h>
#include <hb-ot.h>
#include <linebreak.h>

#include <algorithm>

namespace caryatid::app {
namespace {

struct Letter {
  char32_t code = 0;       // As shaped; a variable's is its sample.
  std::uint16_t byte = 0;  // First byte of it in the text.
  std::uint8_t variable = 0;
  std::uint8_t level = 0;
  std::uint8_t face = 0;
  bool emphasis = false;
  char breaks = LINEBREAK_NOBREAK;  // Behind it.
  hb_script_t script = HB_SCRIPT_COMMON;

  bool blank() const { return code == U' ' || code == U'\n' || code == 0xA0; }
};

std::vector<Letter> decode(const ShapeRequest& request) {
  std::vector<Letter> out;
  const std::string_view text = request.plain;
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    char32_t code = length == 1 ? first : first & (0xFFu >> (length + 1));
    for (std::size_t i = 1; i < length && at + i < text.size(); ++i)
      code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3Fu);
    Letter l;
    l.byte = static_cast<std::uint16_t>(at);
    if (first >= 1 && first <= agent::kVariableCount) {
      l.variable = first;
      code = request.samples[first];
    }
    l.code = code;
    for (const auto& [begin, end] : request.emphasis)
      l.emphasis = l.emphasis || (at >= begin && at < end);
    out.push_back(l);
    at += length;
  }
  return out;
}

// Levels of each paragraph by itself: a line feed ends one.
void find_levels(std::vector<Letter>* letters) {
  std::vector<FriBidiChar> codes;
  for (const Letter& l : *letters) codes.push_back(l.code);
  std::vector<FriBidiCharType> types(codes.size());
  std::vector<FriBidiBracketType> brackets(codes.size());
  std::vector<FriBidiLevel> levels(codes.size());
  for (std::size_t first = 0; first < codes.size();) {
    std::size_t end = first;
    while (end < codes.size() && codes[end] != U'\n') ++end;
    end = std::min(end + 1, codes.size());
    const auto count = static_cast<FriBidiStrIndex>(end - first);
    fribidi_get_bidi_types(&codes[first], count, &types[first]);
    fribidi_get_bracket_types(&codes[first], count, &types[first], &brackets[first]);
    FriBidiParType direction = FRIBIDI_PAR_ON;
    if (fribidi_get_par_embedding_levels_ex(&types[first], &brackets[first], count, &direction,
                                            &levels[first]) == 0)
      std::fill_n(levels.begin() + static_cast<std::ptrdiff_t>(first), end - first, 0);
    first = end;
  }
  for (std::size_t i = 0; i < codes.size(); ++i)
    (*letters)[i].level = static_cast<std::uint8_t>(levels[i]);
}

void find_breaks(std::vector<Letter>* letters, const std::string& language) {
  std::vector<utf32_t> codes;
  for (const Letter& l : *letters) codes.push_back(l.code);
  std::vector<char> breaks(codes.size() + 1);
  set_linebreaks_utf32(codes.data(), codes.size(), language.c_str(), breaks.data());
  for (std::size_t i = 0; i < codes.size(); ++i) (*letters)[i].breaks = breaks[i];
  if (!letters->empty()) letters->back().breaks = LINEBREAK_NOBREAK;  // The end is no break.
}

// Signs that belong to no script take that of the letters before them, else of those behind.
void find_scripts(std::vector<Letter>* letters) {
  hb_unicode_funcs_t* unicode = hb_unicode_funcs_get_default();
  const auto settled = [](hb_script_t s) {
    return s != HB_SCRIPT_COMMON && s != HB_SCRIPT_INHERITED && s != HB_SCRIPT_UNKNOWN;
  };
  hb_script_t latest = HB_SCRIPT_COMMON;
  for (Letter& l : *letters) {
    const hb_script_t own = hb_unicode_script(unicode, l.code);
    if (settled(own)) latest = own;
    l.script = latest;
  }
  for (std::size_t i = letters->size(); i-- > 0;) {
    if ((*letters)[i].script == HB_SCRIPT_COMMON && i + 1 < letters->size())
      (*letters)[i].script = (*letters)[i + 1].script;
    if ((*letters)[i].script == HB_SCRIPT_COMMON) (*letters)[i].script = HB_SCRIPT_LATIN;
  }
}

}  // namespace

struct Shaper::State {
  pack::FontView font;
  std::vector<hb_font_t*> faces;

  bool has(std::size_t face, char32_t code) const {
    hb_codepoint_t glyph = 0;
    return hb_font_get_nominal_glyph(faces[face], code, &glyph) != 0;
  }
  // The face that has the letter; a sign that the face of its neighbour has too stays with it.
  std::size_t face_of(char32_t code, std::size_t before, std::vector<char32_t>* missing) const {
    if (code == U'\n') return before;
    if (has(before, code)) return before;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (has(f, code)) return f;
    missing->push_back(code);
    return before;
  }

  // Shapes letters [first, end), all of one face, script and level, and appends their segments.
  void shape_run(const std::vector<Letter>& letters, std::size_t first, std::size_t end,
                 const std::string& language, ShapedText* out) const;
};

void Shaper::State::shape_run(const std::vector<Letter>& letters, std::size_t first,
                              std::size_t end, const std::string& language, ShapedText* out) const {
  std::vector<std::uint32_t> codes;
  for (const Letter& l : letters) codes.push_back(l.code == U'\n' ? U' ' : l.code);
  hb_buffer_t* buffer = hb_buffer_create();
  hb_buffer_add_utf32(buffer, codes.data(), static_cast<int>(codes.size()),
                      static_cast<unsigned>(first), static_cast<int>(end - first));
  const bool leftwards = letters[first].level % 2 != 0;
  hb_buffer_set_direction(buffer, leftwards ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
  hb_buffer_set_script(buffer, letters[first].script);
  hb_buffer_set_language(buffer, hb_language_from_string(language.c_str(), -1));
  const std::size_t face = letters[first].face;
  hb_shape(faces[face], buffer, nullptr, 0);
  unsigned count = 0;
  const hb_glyph_info_t* info = hb_buffer_get_glyph_infos(buffer, &count);
  const hb_glyph_position_t* place = hb_buffer_get_glyph_positions(buffer, &count);

  for (std::size_t begin = first; begin < end;) {
    std::size_t stop = begin + 1;
    const auto same = [&](std::size_t i) {
      return letters[i - 1].breaks != LINEBREAK_ALLOWBREAK &&
             letters[i - 1].breaks != LINEBREAK_MUSTBREAK &&
             letters[i].blank() == letters[begin].blank() &&
             letters[i].emphasis == letters[begin].emphasis;
    };
    while (stop < end && same(stop)) ++stop;
    agent::Segment s;
    s.first_glyph = static_cast<std::uint32_t>(out->glyphs.size());
    s.text_begin = letters[begin].byte;
    s.level = letters[begin].level;
    std::int32_t width = 0;
    for (unsigned g = 0; g < count; ++g) {
      if (info[g].cluster < begin || info[g].cluster >= stop) continue;
      const pack::FontFace& f = font.faces[face];
      const std::uint32_t own = info[g].codepoint < f.glyph_count ? info[g].codepoint : 0;
      out->glyphs.push_back({static_cast<std::uint16_t>(f.first_glyph + own),
                             static_cast<std::int16_t>(place[g].x_advance),
                             static_cast<std::int16_t>(place[g].x_offset),
                             static_cast<std::int16_t>(place[g].y_offset)});
      width += place[g].x_advance;
    }
    s.glyph_count = static_cast<std::uint16_t>(out->glyphs.size() - s.first_glyph);
    s.width = static_cast<std::uint32_t>(std::max(width, 0));
    const Letter& last = letters[stop - 1];
    if (last.breaks == LINEBREAK_ALLOWBREAK) s.flags |= agent::kBreakAfter;
    if (last.breaks == LINEBREAK_MUSTBREAK) s.flags |= agent::kMustBreak;
    if (letters[begin].blank()) s.flags |= agent::kBlank;
    if (letters[begin].emphasis) s.flags |= agent::kEmphasis;
    out->segments.push_back(s);
    begin = stop;
  }
  hb_buffer_destroy(buffer);
}

Shaper::Shaper(const pack::FontView& font) : state_(std::make_unique<State>()) {
  init_linebreak();
  state_->font = font;
  for (std::size_t f = 0; f < font.faces.size(); ++f) {
    const auto sfnt = font.sfnt(f);
    hb_blob_t* blob = hb_blob_create(reinterpret_cast<const char*>(sfnt.data()),
                                     static_cast<unsigned>(sfnt.size()), HB_MEMORY_MODE_READONLY,
                                     nullptr, nullptr);
    hb_face_t* face = hb_face_create(blob, 0);
    hb_font_t* own = hb_font_create(face);
    hb_font_set_scale(own, static_cast<int>(pack::kUnitsPerEm),
                      static_cast<int>(pack::kUnitsPerEm));
    state_->faces.push_back(own);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
  }
}

Shaper::~Shaper() {
  for (hb_font_t* f : state_->faces) hb_font_destroy(f);
}

std::vector<agent::TypeLetter> Shaper::letters() const {
  std::vector<agent::TypeLetter> out;
  for (std::size_t f = 0; f < state_->faces.size(); ++f) {
    const pack::FontFace& face = state_->font.faces[f];
    hb_set_t* codes = hb_set_create();
    hb_face_collect_unicodes(hb_font_get_face(state_->faces[f]), codes);
    hb_codepoint_t code = HB_SET_VALUE_INVALID;
    while (hb_set_next(codes, &code)) {
      hb_codepoint_t glyph = 0;
      if (!hb_font_get_nominal_glyph(state_->faces[f], code, &glyph)) continue;
      if (glyph >= face.glyph_count) continue;
      const auto advance =
          static_cast<std::int16_t>(hb_font_get_glyph_h_advance(state_->faces[f], glyph));
      out.push_back({code, static_cast<std::uint16_t>(face.first_glyph + glyph), advance});
    }
    hb_set_destroy(codes);
  }
  const auto before = [](const auto& a, const auto& b) { return a.code < b.code; };
  std::stable_sort(out.begin(), out.end(), before);
  const auto same = [](const auto& a, const auto& b) { return a.code == b.code; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

ShapedText Shaper::shape(const ShapeRequest& request) const {
  ShapedText out;
  std::vector<Letter> letters = decode(request);
  if (letters.empty()) return out;
  const std::string language(request.language);
  find_levels(&letters);
  find_breaks(&letters, language);
  find_scripts(&letters);
  std::size_t face = 0;
  for (Letter& l : letters)
    face = l.face = static_cast<std::uint8_t>(state_->face_of(l.code, face, &out.missing));
  for (std::size_t first = 0; first < letters.size();) {
    std::size_t end = first + 1;
    const Letter& start = letters[first];
    const auto same = [&](const Letter& l) {
      return l.level == start.level && l.face == start.face && l.script == start.script &&
             l.variable == 0 && start.variable == 0;
    };
    while (end < letters.size() && same(letters[end])) ++end;
    const std::size_t from = out.segments.size();
    state_->shape_run(letters, first, end, language, &out);
    if (start.variable != 0) {  // Its sample's glyphs are not shown.
      agent::Segment& s = out.segments[from];
      out.glyphs.resize(s.first_glyph);
      s.glyph_count = 0;
      s.width = 0;
      s.variable = start.variable;
    }
    first = end;
  }
  for (std::size_t i = 0; i < out.segments.size(); ++i)
    out.segments[i].text_end = i + 1 < out.segments.size()
                                   ? out.segments[i + 1].text_begin
                                   : static_cast<std::uint16_t>(request.plain.size());
  return out;
}

}  // namespace caryatid::app
