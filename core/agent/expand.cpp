// Filling the variables of a line in: the one part of a text that is not known when it is compiled.
#include <algorithm>

#include "core/agent/programme.h"

namespace caryatid::agent {
namespace {

constexpr std::int32_t kBlankWidth = 532;  // A quarter of an em, as in most fonts.
constexpr std::uint32_t kPartPause_ms = 350;

// The pieces of a variable's value, as indices into a language's table.
struct Pieces {
  std::array<std::size_t, 5> index{};
  std::size_t count = 0;
  void add(std::size_t i) { index[count++] = i; }
  // Two digits, or as many as there are.
  void add_number(unsigned n, bool two) {
    if (two || n >= 10) add(kDigitValues + n / 10 % 10);
    add(kDigitValues + n % 10);
  }
};

Pieces pieces_of(Variable variable, const Schedule& schedule, const Moment& now) {
  Pieces p;
  switch (variable) {
    case Variable::none:
      break;
    case Variable::time:
      p.add_number(now.minute / 60u, true);
      p.add(kColonValue);
      p.add_number(now.minute % 60u, true);
      break;
    case Variable::weekday:
      p.add(kWeekdayValues + now.weekday % 7u);
      break;
    case Variable::day:
      p.add_number(now.day, false);
      break;
    case Variable::month:
      p.add(kMonthValues + (now.month + 11u) % 12u);
      break;
    case Variable::opening_hours:
      p.add(kHoursValues + now.weekday % 7u);
      break;
    case Variable::open_state:
      p.add(kStateValues + (is_open(schedule, now) ? 1u : 0u));
      break;
  }
  return p;
}

class Expander {
 public:
  Expander(const Programme& p, const Line& line, const Moment& now, Utterable* out,
           FixedVector<scene::ShapedGlyph, 512>* glyphs)
      : p_(p), line_(line), now_(now), out_(out), glyphs_(glyphs) {}

  void run() {
    const std::string_view plain = p_.text(line_.plain);
    const auto cues = p_.cues.subspan(line_.cues.first, line_.cues.count);
    std::size_t cue = 0, at = 0;
    const auto take_cues = [&](std::size_t until) {
      for (; cue < cues.size() && cues[cue].at <= until; ++cue) {
        Cue moved = cues[cue];
        moved.at = static_cast<std::uint16_t>(out_->text.size());
        (void)out_->cues.push(moved);
      }
    };
    for (const Segment& s : p_.segments.subspan(line_.segments.first, line_.segments.count)) {
      for (; at < s.text_begin; ++at) copy(plain[at], &take_cues, at);
      const std::size_t begin = out_->text.size();
      if (s.variable != 0) {
        take_cues(at);
        at = s.text_end;
        if (!add_value(s, begin)) return;
        continue;
      }
      for (; at < s.text_end; ++at) copy(plain[at], &take_cues, at);
      if (out_->text.size() - begin != std::size_t{s.text_end} - s.text_begin ||
          !push(s, begin, p_.glyphs.subspan(s.first_glyph, s.glyph_count),
                static_cast<std::int32_t>(s.width)))
        return;
    }
    for (; at < plain.size(); ++at) copy(plain[at], &take_cues, at);
    take_cues(plain.size());
  }

 private:
  template <class TakeCues>
  void copy(char c, const TakeCues* take_cues, std::size_t at) {
    (*take_cues)(at);
    (void)out_->text.push(c);
  }

  bool push(const Segment& s, std::size_t begin, std::span<const scene::ShapedGlyph> glyphs,
            std::int32_t width) {
    scene::Run run;
    run.glyphs = glyphs;
    run.width = width;
    run.text_begin = static_cast<std::uint16_t>(begin);
    run.text_end = static_cast<std::uint16_t>(out_->text.size());
    run.level = s.level;
    run.break_after = (s.flags & kBreakAfter) != 0;
    run.must_break_after = (s.flags & kMustBreak) != 0;
    run.blank = (s.flags & kBlank) != 0;
    run.emphasis = (s.flags & kEmphasis) != 0;
    return out_->runs.push(run);
  }

  bool add_value(const Segment& s, std::size_t begin) {
    const std::size_t first_glyph = glyphs_->size();
    std::int32_t width = 0;
    const Pieces pieces = pieces_of(static_cast<Variable>(s.variable), p_.header->schedule, now_);
    for (std::size_t i = 0; i < pieces.count; ++i) {
      const Value& v = p_.values[line_.language * kValueCount + pieces.index[i]];
      for (const char c : p_.text(v.text))
        if (!out_->text.push(c)) return false;
      for (const scene::ShapedGlyph& g : p_.glyphs.subspan(v.glyphs.first, v.glyphs.count))
        if (!glyphs_->push(g)) return false;
      width += static_cast<std::int32_t>(v.width);
    }
    return push(s, begin, glyphs_->span().subspan(first_glyph), width);
  }

  const Programme& p_;
  const Line& line_;
  Moment now_;
  Utterable* out_;
  FixedVector<scene::ShapedGlyph, 512>* glyphs_;
};

}  // namespace

void expand(const Programme& programme, const Line& line, const Moment& now, Utterable* out) {
  out->clear();
  out->language = line.language;
  append(programme, line, now, out);
}

void append(const Programme& programme, const Line& line, const Moment& now, Utterable* out) {
  const auto at = static_cast<std::uint16_t>(out->text.size());
  const bool other = line.language != out->language;
  if (other) (void)out->cues.push({at, CueKind::language, 0, line.language});
  Expander(programme, line, now, out, &out->value_glyphs_).run();
  const auto end = static_cast<std::uint16_t>(out->text.size());
  if (other) (void)out->cues.push({end, CueKind::language, 0, out->language});
}

void append_value(const Programme& programme, std::uint16_t language, std::size_t value,
                  Utterable* out) {
  const Value& v = programme.values[language * kValueCount + value];
  const std::size_t begin = out->text.size(), first = out->value_glyphs_.size();
  for (const char c : programme.text(v.text))
    if (!out->text.push(c)) return;
  for (const scene::ShapedGlyph& g : programme.glyphs.subspan(v.glyphs.first, v.glyphs.count))
    if (!out->value_glyphs_.push(g)) return;
  scene::Run run;
  run.glyphs = out->value_glyphs_.span().subspan(first);
  run.width = static_cast<std::int32_t>(v.width);
  run.text_begin = static_cast<std::uint16_t>(begin);
  run.text_end = static_cast<std::uint16_t>(out->text.size());
  (void)out->runs.push(run);
}

void append_blank(Utterable* out) {
  if (!out->text.push(' ')) return;
  scene::Run run;
  run.width = kBlankWidth;
  run.text_begin = static_cast<std::uint16_t>(out->text.size() - 1);
  run.text_end = static_cast<std::uint16_t>(out->text.size());
  run.blank = run.break_after = true;
  (void)out->runs.push(run);
}

void begin_part(Utterable* out) {
  if (out->runs.empty()) return;
  out->runs[out->runs.size() - 1].must_break_after = true;
  (void)out->text.push(' ');
  const auto at = static_cast<std::uint16_t>(out->text.size());
  (void)out->cues.push({at, CueKind::pause, 0, kPartPause_ms});
}

}  // namespace caryatid::agent
