#pragma once
// Shaping: from a parsed text to segments that the agent only has to place. Directions by FriBidi
// (UAX 9), break opportunities by libunibreak (UAX 14), glyphs by HarfBuzz from the font pack's own
// tables. Runs at start and in the child process of a reload, never in the agent's loop.
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/agent/programme.h"
#include "core/agent/type_case.h"
#include "core/pack/font.h"

namespace caryatid::app {

struct ShapedText {
  std::vector<agent::Segment> segments;  // first_glyph counts `glyphs`.
  std::vector<scene::ShapedGlyph> glyphs;
  std::vector<char32_t> missing;  // Code points that the font lacks; shown as its empty box.
};

struct ShapeRequest {
  std::string_view plain;            // UTF-8; bytes of 1..agent::kVariableCount are variables.
  std::string_view language = "en";  // BCP 47; chooses letter forms and line breaks.
  // What stands in for a variable while directions and breaks are found, by variable.
  std::array<char32_t, agent::kVariableCount + 1> samples{};
  std::vector<std::pair<std::uint16_t, std::uint16_t>> emphasis;  // Byte ranges of `plain`.
};

class Shaper {
 public:
  // Borrows the font pack.
  explicit Shaper(const pack::FontView& font);
  ~Shaper();
  Shaper(const Shaper&) = delete;
  Shaper& operator=(const Shaper&) = delete;

  ShapedText shape(const ShapeRequest& request) const;
  // Every letter of the fonts as it looks by itself, by code; the first face that has it.
  std::vector<agent::TypeLetter> letters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace caryatid::app
