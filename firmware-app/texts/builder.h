#pragma once
// Collects the records of a programme and writes them as the block of core/agent/programme.h.
#include <map>
#include <string>
#include <vector>

#include "core/agent/programme.h"
#include "firmware-app/texts/shaper.h"
#include "firmware-app/texts/ssml_parser.h"

namespace caryatid::app {

class ProgrammeBuilder {
 public:
  std::vector<agent::Language> languages;
  std::vector<agent::ButtonRecord> buttons;
  std::vector<agent::Page> pages;
  std::vector<agent::Choice> choices;
  std::vector<agent::PictureRecord> pictures;
  std::vector<agent::Line> lines;
  std::vector<agent::Value> values;
  std::uint32_t text_count = 0;
  std::uint16_t start_page = 0;
  bool always_shown = false;
  agent::Schedule schedule;
  agent::Attract attract;

  // The same text is stored once.
  agent::Ref bytes(std::string_view text);
  agent::Line line(const ParsedText& text, const ShapedText& shaped, std::uint16_t language);
  // A value of a variable, in visual order.
  agent::Value value(std::string_view text, const ShapedText& shaped);

  std::vector<std::byte> write(std::uint32_t font_crc) const;

 private:
  std::map<std::string, agent::Ref, std::less<>> known_;
  std::string bytes_;
  std::vector<agent::Segment> segments_;
  std::vector<scene::ShapedGlyph> glyphs_;
  std::vector<agent::Cue> cues_;
};

}  // namespace caryatid::app
