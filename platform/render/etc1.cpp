#include "platform/render/etc1.h"

#include <algorithm>
#include <cassert>

namespace caryatid::platform {
namespace {

// Table 3.17.2 of the extension: modifiers by codeword; the pixel's two bits choose
// +small, +large, -small, -large.
constexpr int kModifier[8][2] = {{2, 8},   {5, 17},  {9, 29},   {13, 42},
                                 {18, 60}, {24, 80}, {33, 106}, {47, 183}};

struct Block {
  int base[2][3];  // Colour of each half, 0..255.
  int table[2];
  bool flipped;             // Halves lie above each other instead of side by side.
  std::uint32_t selectors;  // Bit i: low bits, bit 16 + i: high bits; i = x * 4 + y.
};

Block parse(const std::uint8_t* b) {
  Block out{};
  const bool differential = (b[3] & 2) != 0;
  for (int c = 0; c < 3; ++c) {
    if (differential) {
      const int first = b[c] >> 3;
      const int delta = (b[c] & 7) >= 4 ? (b[c] & 7) - 8 : b[c] & 7;
      const int second = (first + delta) & 31;
      out.base[0][c] = first << 3 | first >> 2;
      out.base[1][c] = second << 3 | second >> 2;
    } else {
      out.base[0][c] = (b[c] >> 4) * 17;
      out.base[1][c] = (b[c] & 15) * 17;
    }
  }
  out.table[0] = b[3] >> 5;
  out.table[1] = (b[3] >> 2) & 7;
  out.flipped = (b[3] & 1) != 0;
  out.selectors = static_cast<std::uint32_t>(b[4]) << 24 | static_cast<std::uint32_t>(b[5]) << 16 |
                  static_cast<std::uint32_t>(b[6]) << 8 | b[7];
  return out;
}

std::uint16_t texel(const Block& block, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t i = x * 4 + y;
  const int half = (block.flipped ? y : x) >= 2 ? 1 : 0;
  const bool large = (block.selectors >> i & 1u) != 0;
  const bool negative = (block.selectors >> (16 + i) & 1u) != 0;
  const int size = kModifier[block.table[half]][large ? 1 : 0];
  const int modifier = negative ? -size : size;
  const int* base = block.base[half];
  const int r = std::clamp(base[0] + modifier, 0, 255);
  const int g = std::clamp(base[1] + modifier, 0, 255);
  const int b = std::clamp(base[2] + modifier, 0, 255);
  return static_cast<std::uint16_t>((r >> 3) << 11 | (g >> 2) << 5 | b >> 3);
}

}  // namespace

void decode_etc1(std::span<const std::uint8_t> blocks, std::uint32_t width, std::uint32_t height,
                 std::span<std::uint16_t> out_rgb565) {
  assert(blocks.size() >= etc1_bytes(width, height));
  assert(out_rgb565.size() >= std::size_t{width} * height);
  const std::uint8_t* at = blocks.data();
  for (std::uint32_t by = 0; by < height; by += 4) {
    for (std::uint32_t bx = 0; bx < width; bx += 4, at += 8) {
      const Block block = parse(at);
      for (std::uint32_t y = by; y < std::min(by + 4, height); ++y)
        for (std::uint32_t x = bx; x < std::min(bx + 4, width); ++x)
          out_rgb565[std::size_t{y} * width + x] = texel(block, x - bx, y - by);
    }
  }
}

}  // namespace caryatid::platform
