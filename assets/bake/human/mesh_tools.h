#pragma once
// From quads with separate texture coordinates to the triangle meshes of model.h. Internal to the
// room.
#include <functional>
#include <span>
#include <vector>

#include "assets/bake/human/makehuman.h"

namespace caryatid::bake {

// Normals of quads' corners summed at their vertices, weighted by the corner's angle: the result
// does not depend on how a face is cut into triangles. Vertices without a face get +Z.
std::vector<Vec3> smooth_normals(std::span<const Quad> quads, std::span<const Vec3> position_m);

// What a Mesh is made from; arrays by vertex of the owner.
struct MeshSource {
  std::span<const Quad> quads;
  std::span<const Vec3> position_m;
  std::span<const Vec3> normal;
  std::span<const Vec2> uv;  // v upwards.
  std::function<Influence(std::uint32_t vertex)> influence;
  bool from_base = false;  // Vertex numbers are hm08's.
};

// Takes the quads that `keep` accepts, cuts them along the shorter diagonal and doubles vertices at
// texture seams.
Mesh make_mesh(const MeshSource& source, const std::function<bool(const Quad&)>& keep);

// Vertices of `mesh` by owner's vertex: first match or kNone.
std::vector<std::uint32_t> slot_of_base(const Mesh& mesh, std::size_t base_count);

// For every vertex the number of the connected piece that it belongs to; pieces count from 0.
std::vector<std::uint32_t> pieces_of(std::span<const Quad> quads, std::size_t vertex_count);

// For every vertex the least number of a vertex that quads connect it with.
std::vector<std::uint32_t> connected_pieces(std::span<const Quad> quads, std::size_t vertex_count);

// Neighbours of every vertex along quad edges.
std::vector<std::vector<std::uint32_t>> edge_neighbours(std::span<const Quad> quads,
                                                        std::size_t vertex_count);

}  // namespace caryatid::bake
