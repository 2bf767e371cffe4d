#include "core/pack/font.h"

#include <cstring>

#include "core/base/crc.h"

namespace caryatid::pack {
namespace {

constexpr std::uint32_t kMostAtlasSide = 2048;

constexpr Status refuse(FontRefusal why, Code code = Code::corrupt_data) {
  return {code, static_cast<std::uint16_t>(why)};
}

bool power_of_two(std::uint32_t n) { return n > 0 && (n & (n - 1)) == 0; }

bool header_fits(const FontHeader& h, std::size_t size) {
  const std::size_t tables =
      sizeof h + h.face_count * sizeof(FontFace) + h.glyph_count * sizeof(FontGlyph);
  const std::size_t atlas = std::size_t{h.atlas_width} * h.atlas_height;
  return h.bytes == size && tables <= size && h.atlas_offset >= tables && h.atlas_offset <= size &&
         atlas <= size - h.atlas_offset && h.face_count > 0 && h.glyph_count > 0 &&
         h.box_glyph < h.glyph_count && h.em_px > 0 && h.spread_px > 0 &&
         power_of_two(h.atlas_width) && power_of_two(h.atlas_height) &&
         h.atlas_width <= kMostAtlasSide && h.atlas_height <= kMostAtlasSide;
}

bool ranges_hold(const FontView& v) {
  for (const FontFace& f : v.faces) {
    if (std::size_t{f.first_glyph} + f.glyph_count > v.glyphs.size()) return false;
    if (f.sfnt_offset > v.header->bytes || f.sfnt_bytes > v.header->bytes - f.sfnt_offset)
      return false;
    if (f.name[sizeof f.name - 1] != '\0') return false;
    for (std::size_t g = 1; g < f.glyph_count; ++g)
      if (v.glyphs[f.first_glyph + g].glyph_id <= v.glyphs[f.first_glyph + g - 1].glyph_id)
        return false;
  }
  for (const FontGlyph& g : v.glyphs)
    if (g.x + g.width > v.header->atlas_width || g.y + g.height > v.header->atlas_height)
      return false;
  return true;
}

}  // namespace

Result<FontView> read_font(std::span<const std::byte> bytes) {
  FontView view;
  if (bytes.size() < sizeof(FontHeader)) return {refuse(FontRefusal::too_short), {}};
  view.header = reinterpret_cast<const FontHeader*>(bytes.data());
  const FontHeader& h = *view.header;
  if (std::memcmp(h.magic, kFontMagic, sizeof kFontMagic) != 0)
    return {refuse(FontRefusal::bad_magic), {}};
  if (h.version != kFontVersion) return {refuse(FontRefusal::version, Code::unsupported), {}};
  if (h.bytes != bytes.size()) return {refuse(FontRefusal::too_short), {}};
  if (crc32c(bytes.subspan(sizeof h)) != h.crc) return {refuse(FontRefusal::crc), {}};
  if (!header_fits(h, bytes.size())) return {refuse(FontRefusal::ranges), {}};
  const auto* faces = reinterpret_cast<const FontFace*>(bytes.data() + sizeof h);
  view.faces = {faces, h.face_count};
  view.glyphs = {reinterpret_cast<const FontGlyph*>(faces + h.face_count), h.glyph_count};
  view.atlas = bytes.subspan(h.atlas_offset, std::size_t{h.atlas_width} * h.atlas_height);
  if (!ranges_hold(view)) return {refuse(FontRefusal::ranges), {}};
  return {{}, view};
}

}  // namespace caryatid::pack
