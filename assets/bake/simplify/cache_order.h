#pragma once
// Triangle orders that keep the small vertex cache of a GPU busy.
#include <array>
#include <cstdint>
#include <vector>

namespace caryatid::bake {

using TriangleList = std::vector<std::array<std::uint32_t, 3>>;

// VC4 and small Vivante cores hold about 16 transformed vertices.
inline constexpr std::uint32_t kVertexCacheSize = 16;

// An order (indices into `triangles`) with few misses of a FIFO cache: Tipsify (Sander, Nehab &
// Barczak 2007), fan by fan around the vertex that is oldest in the cache but will stay. O(n).
std::vector<std::uint32_t> cache_order(const TriangleList& triangles, std::uint32_t vertex_count,
                                       std::uint32_t cache_size = kVertexCacheSize);

// Misses a triangle of a FIFO cache: 0.5 is the limit for large grids, 3 the worst.
double misses_per_triangle(const TriangleList& triangles,
                           std::uint32_t cache_size = kVertexCacheSize);

}  // namespace caryatid::bake
