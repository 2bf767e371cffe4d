#include "firmware-app/texts/ssml_parser.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/body/gesture.h"

namespace caryatid::app {
namespace {

using agent::CueKind;

constexpr unsigned kLongestPause_ms = 10000;

struct Tag {
  std::string name;
  std::map<std::string, std::string> attributes;
  bool closes = false, empty = false;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == ':';
}

// The tag's inside, between its angle brackets.
Tag read_tag(std::string_view inside) {
  Tag tag;
  std::size_t at = 0;
  tag.closes = inside.starts_with('/');
  if (tag.closes) inside.remove_prefix(1);
  tag.empty = inside.ends_with('/');
  if (tag.empty) inside.remove_suffix(1);
  const auto skip = [&] {
    while (at < inside.size() && is_blank(inside[at])) ++at;
  };
  const auto name = [&] {
    const std::size_t first = at;
    while (at < inside.size() && is_name(inside[at])) ++at;
    return std::string(inside.substr(first, at - first));
  };
  tag.name = name();
  for (skip(); at < inside.size(); skip()) {
    const std::string key = name();
    skip();
    if (key.empty() || at >= inside.size() || inside[at] != '=') break;
    ++at;
    skip();
    if (at >= inside.size() || (inside[at] != '"' && inside[at] != '\'')) break;
    const std::size_t end = inside.find(inside[at], at + 1);
    if (end == std::string_view::npos) break;
    tag.attributes[key] = std::string(inside.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return tag;
}

void append_utf8(char32_t c, std::string* out) {
  const auto push = [out](char32_t byte) { out->push_back(static_cast<char>(byte)); };
  if (c < 0x80) {
    push(c);
  } else if (c < 0x800) {
    push(0xC0 | c >> 6);
    push(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    push(0xE0 | c >> 12);
    push(0x80 | (c >> 6 & 0x3F));
    push(0x80 | (c & 0x3F));
  } else {
    push(0xF0 | c >> 18);
    push(0x80 | (c >> 12 & 0x3F));
    push(0x80 | (c >> 6 & 0x3F));
    push(0x80 | (c & 0x3F));
  }
}

class Parser {
 public:
  Parser(std::string_view source, const SsmlContext& context)
      : source_(source), context_(context) {}

  ParsedText run() {
    for (at_ = 0; at_ < source_.size();) {
      if (out_.plain.size() > kMaxTextBytes) break;
      const char c = source_[at_];
      if (c == '<' && tag()) continue;
      if (c == '&' && entity()) continue;
      if (c == '{' && variable()) continue;
      put(c);
      ++at_;
    }
    cut();
    finish();
    return std::move(out_);
  }

 private:
  void complain(std::size_t at, const std::string& what) {
    if (said_.insert(what).second && context_.complain) context_.complain(at, what);
  }

  // White space of any length is one blank; other control characters are dropped.
  void put(char c) {
    if (is_blank(c)) {
      if (!out_.plain.empty() && out_.plain.back() != ' ' && out_.plain.back() != '\n')
        out_.plain.push_back(' ');
    } else if (static_cast<unsigned char>(c) >= ' ' && c != 0x7F) {
      out_.plain.push_back(c);
    }
  }

  void cue(CueKind kind, std::uint32_t value) {
    out_.cues.push_back(
        {static_cast<std::uint16_t>(std::min(out_.plain.size(), kMaxTextBytes)), kind, 0, value});
  }

  bool tag() {
    const char next = at_ + 1 < source_.size() ? source_[at_ + 1] : ' ';
    if (!is_name(next) && next != '/' && next != '!' && next != '?') {
      complain(at_, "a lone '<'; write &lt; for the sign itself");
      return false;
    }
    const std::size_t end = source_.find('>', at_);
    if (end == std::string_view::npos) {
      complain(at_, "a tag without its '>'; close it, or write &lt; for the sign itself");
      return false;
    }
    const std::size_t start = at_;
    const Tag tag = read_tag(source_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    if (next != '!' && next != '?') obey(tag, start);
    return true;
  }

  void obey(const Tag& tag, std::size_t at) {
    if (tag.name == "speak" || tag.name == "s") return;
    if (tag.name == "p") return paragraph();
    if (tag.name == "break") return pause(tag, at);
    if (tag.name == "mark") return mark(tag, at);
    if (tag.name == "emphasis") return toggle(CueKind::emphasis, &emphasis_, tag, at);
    if (tag.name == "say-as") return say_as(tag, at);
    if (tag.name == "lang") return language(tag, at);
    complain(at, "unknown tag <" + tag.name +
                     ">; known are break, emphasis, say-as, mark, lang, p, s (the text is spoken "
                     "without it)");
  }

  void paragraph() {
    while (!out_.plain.empty() && out_.plain.back() == ' ') out_.plain.pop_back();
    if (!out_.plain.empty() && out_.plain.back() != '\n') out_.plain.push_back('\n');
  }

  static std::string attribute(const Tag& tag, const char* name) {
    const auto found = tag.attributes.find(name);
    return found == tag.attributes.end() ? std::string() : found->second;
  }

  void pause(const Tag& tag, std::size_t at) {
    static const std::map<std::string, unsigned> kStrengths = {{"none", 0},     {"x-weak", 100},
                                                               {"weak", 250},   {"medium", 500},
                                                               {"strong", 800}, {"x-strong", 1200}};
    const std::string time = attribute(tag, "time"), strength = attribute(tag, "strength");
    double ms = 500.0;
    if (!time.empty()) {
      char* end = nullptr;
      ms = std::strtod(time.c_str(), &end);
      const std::string unit = end;
      if (unit == "s") ms *= 1000.0;
      if ((unit != "s" && unit != "ms") || !(ms >= 0.0) || ms > kLongestPause_ms) {
        complain(at, "a break of '" + time + "'; write up to 10 seconds as 500ms or 1.5s");
        ms = 500.0;
      }
    } else if (!strength.empty()) {
      const auto found = kStrengths.find(strength);
      if (found == kStrengths.end())
        complain(at, "a break of strength '" + strength + "'; use weak, medium or strong");
      else
        ms = found->second;
    }
    cue(CueKind::pause, static_cast<std::uint32_t>(ms));
  }

  void mark(const Tag& tag, std::size_t at) {
    const std::string name = attribute(tag, "name");
    for (auto k = body::GestureKind::wave; k <= body::GestureKind::beat;
         k = static_cast<body::GestureKind>(static_cast<int>(k) + 1))
      if (name == body::gesture_name(k)) return cue(CueKind::gesture, static_cast<unsigned>(k));
    complain(at, "a mark named '" + name + "'; use wave, point, nod, shake, shrug or beat");
  }

  void toggle(CueKind kind, bool* io_open, const Tag& tag, std::size_t at) {
    if (tag.empty) return;
    if (*io_open == !tag.closes) {
      complain(at, "<" + std::string(tag.closes ? "/" : "") + tag.name + "> " +
                       (tag.closes ? "closes nothing" : "inside itself") + "; pair the tags");
      return;
    }
    *io_open = !tag.closes;
    cue(kind, tag.closes ? 0 : 1);
  }

  void say_as(const Tag& tag, std::size_t at) {
    static const std::set<std::string> kSpelled = {"characters", "spell-out", "digits",
                                                   "telephone"};
    static const std::set<std::string> kRead = {"cardinal", "number", "ordinal", "date", "time"};
    if (tag.closes) {
      if (spell_) toggle(CueKind::spell, &spell_, tag, at);
      return;
    }
    const std::string kind = attribute(tag, "interpret-as");
    if (kSpelled.count(kind) > 0)
      toggle(CueKind::spell, &spell_, tag, at);
    else if (kRead.count(kind) == 0)
      complain(at, "say-as '" + kind +
                       "'; use characters, digits, telephone, cardinal, ordinal, date or time");
  }

  void language(const Tag& tag, std::size_t at) {
    if (tag.closes) {
      if (language_ != context_.language)
        cue(CueKind::language, static_cast<std::uint32_t>(context_.language));
      language_ = context_.language;
      return;
    }
    std::string code = attribute(tag, "xml:lang");
    if (code.empty()) code = attribute(tag, "lang");
    for (std::size_t l = 0; l < context_.languages.size(); ++l)
      if (context_.languages[l] == code) {
        language_ = l;
        return cue(CueKind::language, static_cast<std::uint32_t>(l));
      }
    complain(at, "<lang> '" + code + "' is no language of kiosk.toml; add it to languages");
  }

  bool entity() {
    static const std::map<std::string, char32_t, std::less<>> kNamed = {
        {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
    const std::size_t end = source_.find(';', at_);
    if (end == std::string_view::npos || end - at_ > 9) return false;
    const std::string name(source_.substr(at_ + 1, end - at_ - 1));
    char32_t c = 0;
    if (const auto found = kNamed.find(name); found != kNamed.end()) {
      c = found->second;
    } else if (name.size() > 1 && name[0] == '#') {
      const bool hex = name[1] == 'x';
      char* rest = nullptr;
      c = static_cast<char32_t>(std::strtoul(name.c_str() + (hex ? 2 : 1), &rest, hex ? 16 : 10));
      if (*rest != '\0' || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) c = 0;
    }
    if (c < ' ') {
      complain(at_, "unknown entity &" + name + ";; write &amp; for the sign itself");
      return false;
    }
    append_utf8(c, &out_.plain);
    at_ = end + 1;
    return true;
  }

  bool variable() {
    const std::size_t end = source_.find('}', at_);
    const std::string name(
        source_.substr(at_ + 1, end == std::string_view::npos ? 0 : end - at_ - 1));
    for (std::size_t v = 1; v <= agent::kVariableCount; ++v)
      if (name == agent::kVariableNames[v]) {
        out_.plain.push_back(static_cast<char>(v));
        at_ = end + 1;
        return true;
      }
    if (const auto found = context_.constants.find(name); found != context_.constants.end()) {
      for (const char c : found->second) put(c);
      at_ = end + 1;
      return true;
    }
    std::string known;
    for (std::size_t v = 1; v <= agent::kVariableCount; ++v)
      known += (v > 1 ? ", " : "") + std::string(agent::kVariableNames[v]);
    complain(at_,
             "unknown variable {" + name + "}; known are " + known + " and those of [variables]");
    return false;
  }

  void cut() {
    std::string& plain = out_.plain;
    if (plain.size() > kMaxTextBytes) {
      complain(0, "a text of more than " + std::to_string(kMaxTextBytes) +
                      " bytes; it is cut there: spread it over several pages");
      std::size_t end = plain.rfind(' ', kMaxTextBytes - 4);
      if (end == std::string::npos) end = kMaxTextBytes - 4;
      while (end > 0 && (static_cast<unsigned char>(plain[end]) & 0xC0) == 0x80) --end;
      plain.resize(end);
      plain += "\xE2\x80\xA6";
    }
    while (!plain.empty() && (plain.back() == ' ' || plain.back() == '\n')) plain.pop_back();
  }

  void finish() {
    if (emphasis_) cue(CueKind::emphasis, 0);
    if (spell_) cue(CueKind::spell, 0);
    if (language_ != context_.language)
      cue(CueKind::language, static_cast<std::uint32_t>(context_.language));
    if (emphasis_ || spell_) complain(source_.size(), "a tag is never closed; close it");
    const auto most = static_cast<std::uint16_t>(out_.plain.size());
    for (agent::Cue& c : out_.cues) c.at = std::min(c.at, most);
  }

  std::string_view source_;
  const SsmlContext& context_;
  ParsedText out_;
  std::set<std::string> said_;
  std::size_t at_ = 0;
  std::size_t language_ = context_.language;
  bool emphasis_ = false, spell_ = false;
};

}  // namespace

ParsedText parse_ssml(std::string_view source, const SsmlContext& context) {
  return Parser(source, context).run();
}

}  // namespace caryatid::app
