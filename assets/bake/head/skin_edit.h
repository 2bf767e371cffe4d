#pragma once
// Small operations on the growing skin of a foreign head.
#include <functional>

#include "assets/bake/head/placed_head.h"

namespace caryatid::bake::foreign {

using Chain = std::vector<std::uint32_t>;

// Marks triangles that can be reached from those at `from` without crossing an edge of the closed
// chain `loop`.
std::vector<bool> outside_of(const PlacedHead& head, const Chain& loop, std::uint32_t from);

// Takes triangles out. Vertices stay, with their numbers.
void remove_triangles(PlacedHead& head, const std::vector<bool>& remove);

// Sews a strip between the border along the closed chain `loop` and a copy of it at place(i) for
// its i-th vertex. Returns the copy. Edges of the loop that are no border get no strip.
Chain add_ring(PlacedHead& head, const Chain& loop, const std::function<Vec3(std::size_t)>& place);

// Closes a border loop with a fan around a new vertex at its mean.
void add_cap(PlacedHead& head, const Chain& loop);

// A new vertex in the middle of an edge; the triangles beside it are split.
std::uint32_t split_edge(PlacedHead& head, std::uint32_t a, std::uint32_t b);

}  // namespace caryatid::bake::foreign
