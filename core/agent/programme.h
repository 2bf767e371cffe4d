#pragma once
// The compiled programme: what the kiosk shows, says and does, as one block of plain records. It is
// compiled from kiosk.toml and the texts (firmware-app/texts) at start, and again by a child
// process when a text changes; the agent only reads it. Little-endian, position-independent, 4-byte
// aligned.
//
// Layout: ProgrammeHeader, then the sections that its table names. Records refer to each other by
// index. validate() checks every index and range once; later code trusts them.
#include <array>
#include <span>
#include <string_view>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/status.h"
#include "core/scene/text.h"

namespace caryatid::agent {

inline constexpr char kProgrammeMagic[8] = {'C', 'A', 'R', 'Y', 'P', 'R', 'O', 'G'};
inline constexpr std::uint32_t kProgrammeVersion = 1;
inline constexpr std::uint16_t kNone = 0xFFFF;  // An index that leads nowhere.

// `count` elements of a section from `first` on.
struct Ref {
  std::uint32_t first = 0, count = 0;
};

enum class Command : std::uint8_t {
  none,
  next_language,
  large_text,     // Turns the mode on or off, as the next two do.
  high_contrast,  //
  captions,       //
  louder,
  softer,
  repeat,  // Says the last text again.
  back,    // To the page before.
  hush,
  describe,  // Says what is shown: title, text, picture, menu.
};
inline constexpr std::array<std::string_view, 11> kCommandNames = {
    "none",   "next-language", "large-text", "high-contrast", "captions", "louder",
    "softer", "repeat",        "back",       "hush",          "describe"};

// What a button, a menu entry or a page brings about. Everything at once; kNone and 0xFF: leave it.
struct Action {
  std::uint8_t feel = 0xFF;  // emotion::Emotion
  std::uint8_t gesture = 0;  // body::GestureKind
  std::uint8_t command = 0;  // Command
  std::uint8_t reserved = 0;
  std::uint16_t say = kNone;  // Text
  std::uint16_t page = kNone, picture = kNone, language = kNone;
};
static_assert(sizeof(Action) == 12);

struct Language {
  Ref code, voice, name;  // "el", "el", "Ελληνικά"; in bytes.
};
struct ButtonRecord {
  Ref name, badge;  // badge: shown beside its menu entry, "5".
  Action action;    // Where the page has no choice for it.
};
struct Choice {
  std::uint16_t button = 0;     // From 1.
  std::uint16_t label = kNone;  // Text
  Action action;
};
struct Page {
  Ref name;
  std::uint16_t title = kNone, body = kNone;  // Texts
  Action enter;                               // What it says, shows, feels; its page is kNone.
  std::uint16_t first_choice = 0, choice_count = 0;
};
struct PictureRecord {
  Ref file;                           // Path beside kiosk.toml.
  std::uint16_t alternative = kNone;  // Text that describes it.
  std::uint16_t reserved = 0;
};

// One text in one language, at lines[text * language_count + language].
struct Line {
  Ref plain;  // UTF-8; a byte of 1..kVariableCount stands for that variable.
  Ref segments, cues;
  std::uint16_t language = 0;  // Another than asked for where a translation is missing.
  std::uint16_t is_there = 0;  // 0: in no language.
};
enum SegmentFlags : std::uint8_t { kBreakAfter = 1, kMustBreak = 2, kBlank = 4, kEmphasis = 8 };
struct Segment {
  std::uint32_t first_glyph = 0;
  std::uint16_t glyph_count = 0;
  std::uint16_t text_begin = 0, text_end = 0;  // Bytes of Line::plain.
  std::uint8_t level = 0, flags = 0;
  std::uint32_t width = 0;
  std::uint8_t variable = 0;  // 0: the glyphs; else the value of that variable.
  std::uint8_t reserved[3] = {};
};
static_assert(sizeof(Segment) == 20);

// What the voice and the body do where the text has got to `at`.
enum class CueKind : std::uint8_t {
  pause,     // value: milliseconds
  gesture,   // value: body::GestureKind
  emphasis,  // value: 1 begins, 0 ends
  language,  // value: language that begins here
  spell,     // value: 1 begins, 0 ends: letter by letter
  mark,      // value: none; a mark without a meaning here, kept for the voice
};
struct Cue {
  std::uint16_t at = 0;  // Byte of Line::plain.
  CueKind kind = CueKind::mark;
  std::uint8_t reserved = 0;
  std::uint32_t value = 0;
};
static_assert(sizeof(Cue) == 8);

// Variables of texts and where their values lie in a language's table.
enum class Variable : std::uint8_t { none, time, weekday, day, month, opening_hours, open_state };
inline constexpr std::size_t kVariableCount = 6;
inline constexpr std::array<std::string_view, kVariableCount + 1> kVariableNames = {
    "", "time", "weekday", "day", "month", "opening_hours", "open_state"};
inline constexpr std::size_t kDigitValues = 0, kColonValue = 10, kWeekdayValues = 11,
                             kMonthValues = 18, kHoursValues = 30, kStateValues = 37,
                             kValueCount = 39;  // State: closed, open.
struct Value {
  Ref text, glyphs;
  std::uint32_t width = 0;
};

struct Schedule {
  std::uint16_t open[7][2] = {};                // Minutes of the day from Monday on; equal: closed.
  std::uint16_t night_from = 0, night_to = 0;   // Equal: no night.
  std::uint8_t volume = 80, night_volume = 80;  // Per cent.
  std::uint8_t sleeps = 0;                      // Outside of the hours the kiosk sleeps.
  std::uint8_t reserved = 0;
};
struct Attract {
  std::uint16_t after_s = 60;  // Without a visitor: back to the first page and language.
  std::uint16_t every_s = 45;  // Then a sign of life so often. 0: never.
  Action action;
};

enum class ProgrammeSection : std::uint8_t {
  bytes,
  languages,
  buttons,
  pages,
  choices,
  pictures,
  lines,
  segments,
  glyphs,
  cues,
  values,
  count
};
inline constexpr std::size_t kProgrammeSections = static_cast<std::size_t>(ProgrammeSection::count);

struct ProgrammeHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t bytes;              // Of the whole block.
  std::uint32_t crc;                // CRC-32C of everything behind these 24 bytes.
  std::uint32_t font_crc;           // Of the font whose glyphs it names.
  Ref section[kProgrammeSections];  // first: offset in bytes; count: elements.
  std::uint32_t text_count;         // Lines are text_count * languages.
  std::uint16_t start_page;
  std::uint16_t always_shown;  // 1: a notice, there for nobody too.
  Schedule schedule;
  Attract attract;
};
inline constexpr std::size_t kProgrammeCrcStart = 24;

// The block as typed spans. Cheap to copy; valid while the block lives.
struct Programme {
  const ProgrammeHeader* header = nullptr;
  std::string_view bytes;
  std::span<const Language> languages;
  std::span<const ButtonRecord> buttons;
  std::span<const Page> pages;  // At least one.
  std::span<const Choice> choices;
  std::span<const PictureRecord> pictures;
  std::span<const Line> lines;
  std::span<const Segment> segments;
  std::span<const scene::ShapedGlyph> glyphs;
  std::span<const Cue> cues;
  std::span<const Value> values;

  std::string_view text(Ref ref) const { return {bytes.data() + ref.first, ref.count}; }
  // nullptr for kNone and for a text that is in no language.
  const Line* line(std::uint16_t text_index, std::uint16_t language) const {
    if (text_index == kNone) return nullptr;
    const Line& l = lines[text_index * languages.size() + language];
    return l.is_there != 0 ? &l : nullptr;
  }
  // Index of the button with this name, or -1. O(buttons).
  int find_button(std::string_view name) const;
};

enum class ProgrammeRefusal : std::uint16_t {
  none,
  too_short,
  bad_magic,
  version,
  crc,
  table,
  text_range,
  bad_index,
  bad_action,
  bad_line,
  bad_segment,
  bad_cue,
  bad_schedule,
  other_font
};
const char* refusal_text(ProgrammeRefusal refusal);

// `block` must be 4-byte aligned and outlive the result. corrupt_data or unsupported with a
// ProgrammeRefusal. glyph_count: of the font that draws it. O(bytes).
Result<Programme> read_programme(std::span<const std::byte> block, std::uint32_t font_crc,
                                 std::size_t glyph_count);

// Local time, as texts and the schedule need it.
struct Moment {
  std::uint8_t weekday = 0;  // 0 Monday .. 6
  std::uint8_t day = 1, month = 1;
  std::uint16_t minute = 0;  // Of the day, 0..1439.
};
bool is_open(const Schedule& schedule, const Moment& now);
bool is_night(const Schedule& schedule, const Moment& now);

// A line with its variables filled in. Large: keep it where it lives.
struct Utterable {
  FixedVector<char, kMaxTextBytes> text;
  scene::Runs runs;
  FixedVector<Cue, 128> cues;  // Their `at` counts bytes of `text`.
  std::uint16_t language = 0;

  void clear() {
    text.clear();
    runs.clear();
    cues.clear();
    value_glyphs_.clear();
  }

 private:
  friend void append(const Programme&, const Line&, const Moment&, Utterable*);
  friend void append_value(const Programme&, std::uint16_t, std::size_t, Utterable*);
  friend class TypeCase;
  FixedVector<scene::ShapedGlyph, 512> value_glyphs_;
};
// Text that does not fit is cut behind a whole word. O(text).
void expand(const Programme& programme, const Line& line, const Moment& now, Utterable* out);
// The same behind what is there already; another language is marked by a cue.
void append(const Programme& programme, const Line& line, const Moment& now, Utterable* out);
// One value of a language's table (kDigitValues and so on), or a blank.
void append_value(const Programme& programme, std::uint16_t language, std::size_t value,
                  Utterable* out);
void append_blank(Utterable* out);
// What follows begins a line of its own, after a pause.
void begin_part(Utterable* out);

}  // namespace caryatid::agent
