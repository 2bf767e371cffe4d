#include "core/agent/programme.h"

#include <algorithm>
#include <cstring>

#include "core/base/crc.h"
#include "core/body/gesture.h"
#include "core/emotion/emotion.h"

namespace caryatid::agent {
namespace {

constexpr std::uint16_t kMinutesADay = 24 * 60;
constexpr auto kLastGesture = static_cast<std::uint8_t>(body::GestureKind::beat);

constexpr Status refuse(ProgrammeRefusal why, Code code = Code::corrupt_data) {
  return {code, static_cast<std::uint16_t>(why)};
}

// Checks one block that is typed already; every method says whether its part holds.
class Checker {
 public:
  Checker(const Programme& p, std::size_t glyph_count) : p_(p), glyph_count_(glyph_count) {}

  ProgrammeRefusal run() const {
    const std::size_t lines = std::size_t{p_.header->text_count} * p_.languages.size();
    if (p_.languages.empty() || p_.languages.size() > kMaxLanguages || p_.pages.empty() ||
        p_.pages.size() > kMaxPages || p_.buttons.size() > kMaxButtons ||
        p_.pictures.size() > kMaxPictures || lines != p_.lines.size() ||
        p_.header->start_page >= p_.pages.size() ||
        p_.values.size() != kValueCount * p_.languages.size())
      return ProgrammeRefusal::table;
    if (!names_hold()) return ProgrammeRefusal::text_range;
    if (!indices_hold()) return ProgrammeRefusal::bad_index;
    if (!actions_hold()) return ProgrammeRefusal::bad_action;
    for (const scene::ShapedGlyph& g : p_.glyphs)
      if (g.glyph >= glyph_count_) return ProgrammeRefusal::bad_segment;
    for (const Value& v : p_.values)
      if (!text(v.text) || !inside(v.glyphs, p_.glyphs.size()) || v.glyphs.count > 64 ||
          v.width > kMostWidth)
        return ProgrammeRefusal::bad_segment;
    for (const Line& l : p_.lines)
      if (const auto why = check(l); why != ProgrammeRefusal::none) return why;
    return schedule_holds() ? ProgrammeRefusal::none : ProgrammeRefusal::bad_schedule;
  }

 private:
  static constexpr std::uint32_t kMostWidth = 1u << 24;  // So that sums of lines stay in 32 bits.

  static bool inside(Ref ref, std::size_t size) {
    return ref.first <= size && ref.count <= size - ref.first;
  }
  bool text(Ref ref) const { return inside(ref, p_.bytes.size()); }
  bool text_index(std::uint16_t i) const { return i == kNone || i < p_.header->text_count; }

  bool names_hold() const {
    for (const Language& l : p_.languages)
      if (!text(l.code) || !text(l.voice) || !text(l.name)) return false;
    for (const ButtonRecord& b : p_.buttons)
      if (!text(b.name) || !text(b.badge)) return false;
    for (const Page& page : p_.pages)
      if (!text(page.name)) return false;
    for (const PictureRecord& picture : p_.pictures)
      if (!text(picture.file)) return false;
    return true;
  }
  bool indices_hold() const {
    for (const Page& page : p_.pages)
      if (!text_index(page.title) || !text_index(page.body) ||
          std::size_t{page.first_choice} + page.choice_count > p_.choices.size())
        return false;
    for (const Choice& c : p_.choices)
      if (c.button < 1 || c.button > p_.buttons.size() || !text_index(c.label)) return false;
    for (const PictureRecord& picture : p_.pictures)
      if (!text_index(picture.alternative)) return false;
    return true;
  }
  bool holds(const Action& a) const {
    return (a.feel == 0xFF || a.feel < emotion::kEmotionCount) && a.gesture <= kLastGesture &&
           a.command < kCommandNames.size() && text_index(a.say) &&
           (a.page == kNone || a.page < p_.pages.size()) &&
           (a.picture == kNone || a.picture < p_.pictures.size()) &&
           (a.language == kNone || a.language < p_.languages.size());
  }
  bool actions_hold() const {
    for (const ButtonRecord& b : p_.buttons)
      if (!holds(b.action)) return false;
    for (const Choice& c : p_.choices)
      if (!holds(c.action)) return false;
    for (const Page& page : p_.pages)
      if (!holds(page.enter) || page.enter.page != kNone) return false;
    return holds(p_.header->attract.action);
  }

  ProgrammeRefusal check(const Line& l) const {
    if (l.is_there == 0) return ProgrammeRefusal::none;
    if (!text(l.plain) || l.plain.count > kMaxTextBytes || l.language >= p_.languages.size() ||
        !inside(l.segments, p_.segments.size()) || !inside(l.cues, p_.cues.size()))
      return ProgrammeRefusal::bad_line;
    std::uint32_t at = 0;
    for (const Segment& s : p_.segments.subspan(l.segments.first, l.segments.count)) {
      if (s.text_begin < at || s.text_end < s.text_begin || s.text_end > l.plain.count ||
          s.variable > kVariableCount || s.width > kMostWidth ||
          !inside({s.first_glyph, s.glyph_count}, p_.glyphs.size()))
        return ProgrammeRefusal::bad_segment;
      at = s.text_end;
    }
    at = 0;
    for (const Cue& c : p_.cues.subspan(l.cues.first, l.cues.count)) {
      const bool known = c.kind <= CueKind::mark &&
                         (c.kind != CueKind::gesture || c.value <= kLastGesture) &&
                         (c.kind != CueKind::language || c.value < p_.languages.size());
      if (!known || c.at < at || c.at > l.plain.count) return ProgrammeRefusal::bad_cue;
      at = c.at;
    }
    return ProgrammeRefusal::none;
  }
  bool schedule_holds() const {
    const Schedule& s = p_.header->schedule;
    for (const auto& day : s.open)
      if (day[0] > kMinutesADay || day[1] > kMinutesADay || day[1] < day[0]) return false;
    return s.night_from < kMinutesADay && s.night_to < kMinutesADay && s.volume <= 100 &&
           s.night_volume <= 100;
  }

  const Programme& p_;
  std::size_t glyph_count_;
};

// A section as a typed span; an empty one with `*io_sound` false when it leaves the block.
template <class T>
std::span<const T> section(std::span<const std::byte> block, ProgrammeSection id, bool* io_sound) {
  const auto& header = *reinterpret_cast<const ProgrammeHeader*>(block.data());
  const Ref ref = header.section[static_cast<std::size_t>(id)];
  *io_sound = *io_sound && ref.first % 4 == 0 && ref.first >= sizeof header &&
              ref.first <= block.size() && ref.count <= (block.size() - ref.first) / sizeof(T);
  if (!*io_sound) return {};
  return {reinterpret_cast<const T*>(block.data() + ref.first), ref.count};
}

bool read_sections(std::span<const std::byte> block, Programme* out) {
  using enum ProgrammeSection;
  bool sound = true;
  const auto text = section<char>(block, bytes, &sound);
  out->bytes = {text.data(), text.size()};
  out->languages = section<Language>(block, languages, &sound);
  out->buttons = section<ButtonRecord>(block, buttons, &sound);
  out->pages = section<Page>(block, pages, &sound);
  out->choices = section<Choice>(block, choices, &sound);
  out->pictures = section<PictureRecord>(block, pictures, &sound);
  out->lines = section<Line>(block, lines, &sound);
  out->segments = section<Segment>(block, segments, &sound);
  out->glyphs = section<scene::ShapedGlyph>(block, glyphs, &sound);
  out->cues = section<Cue>(block, cues, &sound);
  out->values = section<Value>(block, values, &sound);
  return sound;
}

}  // namespace

const char* refusal_text(ProgrammeRefusal refusal) {
  constexpr const char* kTexts[] = {"sound",
                                    "the programme ends too early",
                                    "this is no compiled programme",
                                    "the programme was compiled by another version",
                                    "the programme is damaged",
                                    "the programme's tables make no sense",
                                    "a name of the programme lies outside of its texts",
                                    "the programme refers to a text or button that is not there",
                                    "an action of the programme makes no sense",
                                    "a line of the programme makes no sense",
                                    "a word of the programme makes no sense",
                                    "a mark of the programme makes no sense",
                                    "the programme's schedule makes no sense",
                                    "the programme was compiled for another font"};
  const auto i = static_cast<std::size_t>(refusal);
  return i < std::size(kTexts) ? kTexts[i] : kTexts[4];
}

Result<Programme> read_programme(std::span<const std::byte> block, std::uint32_t font_crc,
                                 std::size_t glyph_count) {
  Programme p;
  if (block.size() < sizeof(ProgrammeHeader)) return {refuse(ProgrammeRefusal::too_short), {}};
  p.header = reinterpret_cast<const ProgrammeHeader*>(block.data());
  if (std::memcmp(p.header->magic, kProgrammeMagic, sizeof kProgrammeMagic) != 0)
    return {refuse(ProgrammeRefusal::bad_magic), {}};
  if (p.header->version != kProgrammeVersion)
    return {refuse(ProgrammeRefusal::version, Code::unsupported), {}};
  if (p.header->bytes != block.size()) return {refuse(ProgrammeRefusal::too_short), {}};
  if (crc32c(block.subspan(kProgrammeCrcStart)) != p.header->crc)
    return {refuse(ProgrammeRefusal::crc), {}};
  if (p.header->font_crc != font_crc)
    return {refuse(ProgrammeRefusal::other_font, Code::unsupported), {}};
  if (!read_sections(block, &p)) return {refuse(ProgrammeRefusal::table), {}};
  if (const auto why = Checker(p, glyph_count).run(); why != ProgrammeRefusal::none)
    return {refuse(why), {}};
  return {{}, p};
}

int Programme::find_button(std::string_view name) const {
  for (std::size_t b = 0; b < buttons.size(); ++b)
    if (text(buttons[b].name) == name) return static_cast<int>(b);
  return -1;
}

bool is_open(const Schedule& schedule, const Moment& now) {
  const auto& day = schedule.open[now.weekday % 7];
  return now.minute >= day[0] && now.minute < day[1];
}

bool is_night(const Schedule& schedule, const Moment& now) {
  const std::uint16_t from = schedule.night_from, to = schedule.night_to;
  if (from <= to) return now.minute >= from && now.minute < to;
  return now.minute >= from || now.minute < to;
}

}  // namespace caryatid::agent
