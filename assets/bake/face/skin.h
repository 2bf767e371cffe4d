#pragma once
// The skin of a head as one welded surface, for weights that run along it: vertices of the base
// human (each once, whatever its texture seams), quads and triangles, edges, edge rings, distances.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake::fat {

struct Skin {
  std::vector<Vec3> position_m;
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // Two a quad.
  std::vector<std::vector<std::uint32_t>> neighbours;   // Along edges of quads, ascending.
  std::vector<std::vector<std::uint32_t>> quads_at;     // By vertex.
  // The way back to the base human, and from it (kNone: not part of this skin).
  std::vector<std::uint32_t> base;
  std::vector<std::uint32_t> of_base;

  std::uint32_t size() const { return static_cast<std::uint32_t>(position_m.size()); }
};

// From quads over `position_m` (numbered like the base human). Vertices that no quad uses are left
// out.
Skin make_skin(std::span<const Vec3> position_m,
               std::span<const std::array<std::uint32_t, 4>> quads);

// From triangles over all of `position_m`, for skins of other origin: no quads, so no rings.
// Vertices keep their numbers, which `base` and `of_base` repeat.
Skin make_triangle_skin(std::span<const Vec3> position_m,
                        std::span<const std::array<std::uint32_t, 3>> triangles);

// The vertices met when walking from `from` through its neighbour `toward` straight on: at vertices
// of four edges into the opposite edge. Stops when the ring closes, at any other vertex, or after
// `at_most` vertices. Starts with `from`.
std::vector<std::uint32_t> ring(const Skin& skin, std::uint32_t from, std::uint32_t toward,
                                std::size_t at_most = 400);

// Length in metres of the shortest way along edges from any of `sources`; vertices farther than
// `limit_m` get infinity. Dijkstra.
std::vector<float> distance_m(const Skin& skin, std::span<const std::uint32_t> sources,
                              float limit_m);

// Area-weighted vertex normals of `position_m` (skin.size() long) over the skin's triangles.
std::vector<Vec3> normals(const Skin& skin, std::span<const Vec3> position_m);

}  // namespace caryatid::bake::fat
