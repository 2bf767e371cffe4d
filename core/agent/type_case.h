#pragma once
// Captions of a text that nobody compiled: one that another program sends to be said. Letters are
// set side by side from a case that was filled at start, so that nothing is parsed and nothing
// allocated; words of right-to-left scripts are set leftwards, letters are not joined (texts of the
// programme are shaped in full when they are compiled).
#include <cstdint>
#include <span>
#include <string_view>

#include "core/agent/programme.h"

namespace caryatid::agent {

// What a code point looks like in the font pack.
struct TypeLetter {
  char32_t code = 0;
  std::uint16_t glyph = 0;   // Index into the font pack's glyphs.
  std::int16_t advance = 0;  // 1/2048 em.
};

// letters: by rising code; their owner keeps them.
class TypeCase {
 public:
  TypeCase() = default;
  explicit TypeCase(std::span<const TypeLetter> letters) : letters_(letters) {}

  // Sets whole words of `text` (UTF-8) from byte `from` on, as many as `out` holds (about 500
  // letters); bytes of `out` are bytes of `text` less `from`. Letters that the font lacks are left
  // out. Returns the byte behind what was set. O(letters).
  std::uint32_t set(std::string_view text, std::uint32_t from, Utterable* out) const;

 private:
  const TypeLetter* find(char32_t code) const;

  std::span<const TypeLetter> letters_;
};

}  // namespace caryatid::agent
