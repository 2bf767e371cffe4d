#pragma once
// From free fonts to the font pack of core/pack/font.h: the code points that the kiosk's texts may
// use, their glyphs after every substitution of the font (HarfBuzz's closure), a distance field of
// each (FreeType), packed into one atlas.
#include <cstddef>
#include <string>
#include <vector>

namespace caryatid::bake {

struct FontRequest {
  std::vector<std::string> files;  // In order of preference: a later one gives what earlier lack.
  unsigned em_px = 30;
  unsigned spread_px = 4;
  unsigned atlas_side = 1024;
};

struct FontReport {
  std::size_t glyphs = 0, code_points = 0;
  double atlas_filled = 0.0;  // 0..1
};

// Throws std::runtime_error with one line: a file that is no font, or glyphs that do not fit.
std::vector<std::byte> bake_font(const FontRequest& request, FontReport* out_report);

// Latin, Greek with polytonic, Cyrillic, Hebrew, Arabic, punctuation, currency, arrows.
std::vector<char32_t> caption_code_points();

}  // namespace caryatid::bake
