#pragma once
// The font pack: glyphs as a signed distance field, and what a shaper needs of the fonts. Baked
// once by `caryatid-tool bake font`; little-endian; one block, validated once, then trusted.
//
// A distance field stays sharp at any size and gives outlines for a threshold: captions need both.
// Layout: FontHeader, FontFace[], FontGlyph[], atlas texels (one byte each, first row on top), then
// the faces' sfnt tables without outlines (for HarfBuzz, where texts are compiled; never while the
// agent runs).
#include <span>

#include "core/base/status.h"

namespace caryatid::pack {

inline constexpr char kFontMagic[8] = {'C', 'A', 'R', 'Y', 'F', 'O', 'N', 'T'};
inline constexpr std::uint32_t kFontVersion = 1;
// All lengths of shaped text are in 1/2048 of the em, whatever the font's own unit.
inline constexpr float kUnitsPerEm = 2048.0f;

struct FontHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t bytes;  // Of the whole block.
  std::uint32_t crc;    // CRC-32C of everything after the header.
  std::uint16_t face_count;
  std::uint16_t glyph_count;
  std::uint16_t atlas_width, atlas_height;  // Powers of two, at most 2048.
  std::uint16_t em_px;                      // Size at which the field was made.
  std::uint16_t spread_px;                  // Texel 255 is so deep inside, 0 so far outside.
  std::uint32_t atlas_offset;
  std::uint32_t box_glyph;  // A full disc of radius spread_px: corners and sides of boxes.
};
static_assert(sizeof(FontHeader) == 40);

struct FontFace {
  char name[32];  // Zero-terminated, for messages and the list of licences.
  std::uint32_t sfnt_offset, sfnt_bytes;
  std::uint16_t first_glyph, glyph_count;  // Its glyphs in the table, sorted by glyph_id.
  std::int16_t ascent, descent;            // 1/2048 em; descent is negative.
};
static_assert(sizeof(FontFace) == 48);

struct FontGlyph {
  std::uint16_t glyph_id;             // In the face.
  std::uint16_t x, y, width, height;  // Texels, the field's margin included. 0 wide: a blank.
  std::int16_t left, top;             // From the pen to the upper left texel's corner, 1/2048 em.
  std::uint16_t reserved;
};
static_assert(sizeof(FontGlyph) == 16);

struct FontView {
  const FontHeader* header = nullptr;
  std::span<const FontFace> faces;
  std::span<const FontGlyph> glyphs;
  std::span<const std::byte> atlas;

  std::span<const std::byte> sfnt(std::size_t face) const {
    const auto* block = reinterpret_cast<const std::byte*>(header);
    return {block + faces[face].sfnt_offset, faces[face].sfnt_bytes};
  }
};

enum class FontRefusal : std::uint16_t { none, too_short, bad_magic, version, crc, ranges };

// `bytes` must be 4-byte aligned and outlive the view. corrupt_data or unsupported, with a
// FontRefusal. O(bytes).
Result<FontView> read_font(std::span<const std::byte> bytes);

}  // namespace caryatid::pack
