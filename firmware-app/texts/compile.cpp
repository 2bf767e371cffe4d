#include "firmware-app/texts/compile.h"

#include <algorithm>
#include <cstdio>

#include "firmware-app/texts/actions.h"
#include "firmware-app/texts/text_tables.h"

namespace caryatid::app {
namespace {

const std::vector<std::string> kEnglishDays = {"Monday", "Tuesday",  "Wednesday", "Thursday",
                                               "Friday", "Saturday", "Sunday"};
const std::vector<std::string> kEnglishMonths = {"January",   "February", "March",    "April",
                                                 "May",       "June",     "July",     "August",
                                                 "September", "October",  "November", "December"};

class Compiler {
 public:
  Compiler(ProgrammeFiles& files, const pack::FontView& font, CompiledProgramme* out)
      : files_(files), shaper_(font), font_crc_(font.header->crc), out_(*out) {}

  void run() {
    const std::string file = files_.full_name(files_.config());
    std::string source, error;
    if (!files_.read(files_.config(), kMostConfigBytes, &source, &error))
      return out_.messages.wrong(file, 0, error);
    if (const std::size_t line = mend_utf8(&source); line != 0)
      out_.messages.wrong(file, line, "not UTF-8; save the file as UTF-8");
    const toml::parse_result result = toml::parse(source, file);
    if (!result)
      return out_.messages.wrong(file, result.error().source().begin.line,
                                 std::string(result.error().description()) + "; mend the line");
    load_languages(result.table());
    ProgrammeReader reader(file, &builder_, &out_.messages);
    reader.read(result.table());
    add_values(reader.hours());
    builder_.text_count = static_cast<std::uint32_t>(reader.texts().size());
    for (const TextUse& use : reader.texts()) add_text(use, file, reader.constants());
    forget_absent_texts();
    say_what_is_missing();
    out_.block = builder_.write(font_crc_);
    if (out_.block.size() <= kMaxProgrammeBytes) return;
    out_.messages.wrong(file, 0,
                        "the programme takes " + std::to_string(out_.block.size() / 1024) +
                            " KiB; it may take " + std::to_string(kMaxProgrammeBytes / 1024) +
                            ": shorten its texts");
    out_.block.clear();
  }

 private:
  void load_languages(const toml::table& root) {
    std::vector<std::string> codes = ProgrammeReader::language_codes(root);
    const bool given = !codes.empty();
    if (!given) codes = {"en"};
    if (codes.size() > kMaxLanguages) {
      out_.messages.wrong(files_.full_name(files_.config()), 0,
                          "at most " + std::to_string(kMaxLanguages) + " languages; cut them");
      codes.resize(kMaxLanguages);
    }
    for (const std::string& code : codes) {
      tables_.push_back(load_texts(code, given, files_, &out_.messages));
      const TextTable& t = tables_.back();
      builder_.languages.push_back(
          {builder_.bytes(t.code), builder_.bytes(t.voice), builder_.bytes(t.name)});
    }
  }

  ShapedText shape(std::string_view plain, const TextTable& table, const ParsedText* cues) const {
    ShapeRequest request;
    request.plain = plain;
    request.language = table.code;
    request.samples.fill(U'0');
    // Names stand for letters of their script; ASCII will do to keep a word together.
    for (const auto v :
         {agent::Variable::weekday, agent::Variable::month, agent::Variable::open_state})
      request.samples[static_cast<std::size_t>(v)] = sample_letter(table);
    std::uint16_t begin = 0;
    if (cues != nullptr)
      for (const agent::Cue& c : cues->cues)
        if (c.kind == agent::CueKind::emphasis) {
          if (c.value != 0)
            begin = c.at;
          else
            request.emphasis.emplace_back(begin, c.at);
        }
    return shaper_.shape(request);
  }

  // First letter of the language's own name: of its script and direction.
  static char32_t sample_letter(const TextTable& table) {
    if (table.name.empty()) return U'a';
    const auto byte = [&](std::size_t i) {
      return i < table.name.size() ? static_cast<unsigned char>(table.name[i]) : 0u;
    };
    if (byte(0) < 0x80) return U'a';
    if (byte(0) < 0xE0) return (byte(0) & 0x1Fu) << 6 | (byte(1) & 0x3Fu);
    return (byte(0) & 0x0Fu) << 12 | (byte(1) & 0x3Fu) << 6 | (byte(2) & 0x3Fu);
  }

  void add_values(const std::array<std::string, 7>& hours) {
    for (const TextTable& t : tables_) {
      std::vector<std::string> texts;
      for (char c = '0'; c <= '9'; ++c) texts.emplace_back(1, c);
      texts.emplace_back(":");
      const auto& days = t.weekdays.empty() ? kEnglishDays : t.weekdays;
      const auto& months = t.months.empty() ? kEnglishMonths : t.months;
      const std::string closed = t.closed.empty() ? "closed" : t.closed;
      texts.insert(texts.end(), days.begin(), days.end());
      texts.insert(texts.end(), months.begin(), months.end());
      for (const std::string& h : hours) texts.push_back(h.empty() ? closed : h);
      texts.push_back(closed);
      texts.push_back(t.open.empty() ? "open" : t.open);
      for (const std::string& text : texts)
        builder_.values.push_back(builder_.value(text, shape(text, t, nullptr)));
    }
  }

  // One text in every language; where it is missing, the first language that has it.
  void add_text(const TextUse& use, const std::string& config,
                const std::map<std::string, std::string>& constants) {
    std::map<std::size_t, agent::Line> made;
    for (std::size_t l = 0; l < tables_.size(); ++l) {
      std::size_t from = l;
      if (tables_[l].texts.count(use.key) == 0)
        for (from = 0; from < tables_.size(); ++from)
          if (tables_[from].texts.count(use.key) > 0) break;
      if (from == tables_.size()) {
        if (!use.optional && l == 0)
          out_.messages.wrong(
              config, use.line,
              "no language has the text '" + use.key + "'; write it in " + tables_[0].file);
        builder_.lines.push_back({});
        continue;
      }
      if (from != l && tables_[l].loaded) missing_[l].push_back({use.key, from});
      if (made.count(from) == 0) made[from] = make_line(use.key, from, constants);
      builder_.lines.push_back(made[from]);
    }
  }

  agent::Line make_line(const std::string& key, std::size_t language,
                        const std::map<std::string, std::string>& constants) {
    const TextTable& table = tables_[language];
    const TextEntry& entry = table.texts.at(key);
    SsmlContext context;
    for (const TextTable& t : tables_) context.languages.push_back(t.code);
    context.language = language;
    context.constants = constants;
    context.complain = [&](std::size_t at, const std::string& what) {
      const auto end =
          entry.text.begin() + static_cast<std::ptrdiff_t>(std::min(at, entry.text.size()));
      const auto lines = static_cast<std::size_t>(std::count(entry.text.begin(), end, '\n'));
      out_.messages.wrong(table.file, entry.line + lines, "'" + key + "': " + what);
    };
    const ParsedText parsed = parse_ssml(entry.text, context);
    const ShapedText shaped = shape(parsed.plain, table, &parsed);
    if (!shaped.missing.empty()) {
      char code[16];
      std::snprintf(code, sizeof code, "U+%04X", static_cast<unsigned>(shaped.missing[0]));
      out_.messages.note(table.file, entry.line,
                         "'" + key + "': the font has no glyph for " + code +
                             "; a box is shown: choose other letters or bake another font");
    }
    return builder_.line(parsed, shaped, static_cast<std::uint16_t>(language));
  }

  // Texts by convention that nobody wrote: nothing refers to them any more.
  void forget_absent_texts() {
    const auto mend = [this](std::uint16_t* text) {
      if (*text != agent::kNone && builder_.lines[*text * tables_.size()].is_there == 0)
        *text = agent::kNone;
    };
    for (agent::Page& p : builder_.pages)
      for (std::uint16_t* text : {&p.title, &p.body, &p.enter.say}) mend(text);
    for (agent::Choice& c : builder_.choices)
      for (std::uint16_t* text : {&c.label, &c.action.say}) mend(text);
    for (agent::ButtonRecord& b : builder_.buttons) mend(&b.action.say);
    for (agent::PictureRecord& p : builder_.pictures) mend(&p.alternative);
    mend(&builder_.attract.action.say);
  }

  // One line a language.
  void say_what_is_missing() {
    for (const auto& [language, keys] : missing_) {
      std::string names;
      for (std::size_t k = 0; k < keys.size() && k < 5; ++k)
        names += (k > 0 ? ", '" : "'") + keys[k].first + "'";
      if (keys.size() > 5) names += " and " + std::to_string(keys.size() - 5) + " more";
      out_.messages.note(tables_[language].file, 0,
                         "there is no " + names + "; translate it from " +
                             tables_[keys[0].second].file + ", which stands in");
    }
  }

  ProgrammeFiles& files_;
  Shaper shaper_;
  std::uint32_t font_crc_;
  CompiledProgramme& out_;
  ProgrammeBuilder builder_;
  std::vector<TextTable> tables_;
  // By language: what it lacks, and which language stands in.
  std::map<std::size_t, std::vector<std::pair<std::string, std::size_t>>> missing_;
};

}  // namespace

CompiledProgramme compile_programme(ProgrammeFiles& files, const pack::FontView& font) {
  CompiledProgramme out;
  Compiler(files, font, &out).run();
  return out;
}

}  // namespace caryatid::app
