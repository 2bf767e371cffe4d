#pragma once
// The two halves of a live vertex, as the renderer uploads them. They lie in separate buffers
// because one changes every frame and the other only with the level of detail.
#include <algorithm>
#include <cstdint>

#include "core/base/vec.h"

namespace caryatid::mesh {

// What moves while the person moves. The CPU writes it, the GPU gets the ranges that changed.
struct DynamicVertex {
  Vec3 position_m;        // Rest space, after geomorph and FAT deformation, before skinning.
  std::int8_t normal[4];  // Signed normalised; [3]: ambient occlusion, 0 open .. 127 closed.
};
static_assert(sizeof(DynamicVertex) == 16);

// What changes only when a level of detail does.
struct StaticVertex {
  std::uint16_t uv[2];     // Unsigned normalised.
  std::uint8_t bone[4];    // Index into the palette of the object.
  std::uint8_t weight[4];  // Sum 255.
};
static_assert(sizeof(StaticVertex) == 12);

// Elements [first, first + count) of a buffer; count 0 is the empty range.
struct DirtyRange {
  std::uint32_t first = 0, count = 0;

  constexpr void add(std::uint32_t index) {
    if (count == 0) {
      first = index;
      count = 1;
      return;
    }
    const std::uint32_t end = std::max(first + count, index + 1);
    first = std::min(first, index);
    count = end - first;
  }
  // Ranges may name elements beyond a prefix that shrank since; this cuts them off.
  constexpr DirtyRange clipped(std::uint32_t live_count) const {
    if (first >= live_count) return {};
    return {first, std::min(count, live_count - first)};
  }
};

}  // namespace caryatid::mesh
