#pragma once
#include <cstdint>
#include <span>

namespace caryatid::platform {

// Bytes of an ETC1 image of this size: 8 for each started block of 4x4.
constexpr std::uint32_t etc1_bytes(std::uint32_t width, std::uint32_t height) {
  return ((width + 3) / 4) * ((height + 3) / 4) * 8;
}

// Expands ETC1 (Khronos OES_compressed_ETC1_RGB8_texture) to RGB565, for GPUs without it.
// blocks: etc1_bytes(width, height) long; out_rgb565: width * height long, first row first.
void decode_etc1(std::span<const std::uint8_t> blocks, std::uint32_t width, std::uint32_t height,
                 std::span<std::uint16_t> out_rgb565);

}  // namespace caryatid::platform
