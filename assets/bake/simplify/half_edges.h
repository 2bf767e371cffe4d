#pragma once
// Connectivity of a triangle mesh while it is simplified: three half-edges a triangle, in arrays.
// Half-edge h = 3 t + i runs from vertex from[h] to from[next(h)]; its left side is triangle t.
// Every vertex is one fan of triangles (closed, or open at a border). 26 bytes a triangle.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace caryatid::bake {

inline constexpr std::uint32_t kNoHalfEdge = 0xFFFFFFFFu;

constexpr std::uint32_t next_in_triangle(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr std::uint32_t prev_in_triangle(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

struct HalfEdges {
  std::vector<std::uint32_t> from;   // kNoHalfEdge: the triangle is gone.
  std::vector<std::uint32_t> twin;   // kNoHalfEdge at a border.
  std::vector<std::uint32_t> first;  // By vertex: one that starts there; the first of an open fan.

  std::uint32_t to(std::uint32_t h) const { return from[next_in_triangle(h)]; }
  std::uint32_t opposite(std::uint32_t h) const { return from[prev_in_triangle(h)]; }
  bool alive(std::uint32_t triangle) const { return from[3 * triangle] != kNoHalfEdge; }

  // The next half-edge that starts at the same vertex, counter-clockwise; kNoHalfEdge past the last
  // of an open fan.
  std::uint32_t turn(std::uint32_t h) const { return twin[prev_in_triangle(h)]; }
  // An open fan is entered at its clockwise end, so its first half-edge is the one without a twin.
  bool on_border(std::uint32_t vertex) const { return twin[first[vertex]] == kNoHalfEdge; }

  // Calls f(h) for every half-edge that starts at the vertex: once for each triangle of its fan.
  template <class F>
  void for_fan(std::uint32_t vertex, F&& f) const {
    const std::uint32_t start = first[vertex];
    std::uint32_t h = start;
    do {
      f(h);
      h = turn(h);
    } while (h != start && h != kNoHalfEdge);
  }
  // Calls f(v) for every neighbour of the vertex.
  template <class F>
  void for_ring(std::uint32_t vertex, F&& f) const {
    std::uint32_t last = kNoHalfEdge;
    const bool open = on_border(vertex);
    for_fan(vertex, [&](std::uint32_t h) {
      f(to(h));
      last = h;
    });
    if (open) f(opposite(last));
  }
  // The half-edge from a to b, in a triangle left of it; kNoHalfEdge when there is none.
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const;

  // What a collapse does to the triangles. The arrays name the two sides of the edge.
  struct Collapsed {
    std::uint32_t triangle_count = 0;
    std::array<std::uint32_t, 2> triangle{};  // Removed.
  };
  // Merges the end to(h) into from(h): removes the triangles at h, renames the rest of the fan. The
  // edge must satisfy link_condition(). Corners that change their vertex go to `moved`.
  Collapsed collapse(std::uint32_t h, std::vector<std::uint32_t>* moved);

  // Whether the surface stays a surface (Hoppe et al. 1993; thesis 2.2): the ends share no
  // neighbours but the opposite vertices, no border is pinched, and at least a tetrahedron stays (a
  // triangle where there is a border).
  // `scratch` is only there to keep its memory.
  bool link_condition(std::uint32_t h, std::vector<std::uint32_t>& scratch) const;

  // Makes `h`, turned clockwise as far as an open fan goes, the first half-edge of its vertex.
  void rewind(std::uint32_t vertex, std::uint32_t h);
};

// What build_half_edges had to change to get a surface out of arbitrary triangles.
struct TopologyRepairs {
  std::uint32_t non_manifold_edges = 0;     // More than two triangles, or two that disagree about
                                            // the orientation: cut open.
  std::uint32_t non_manifold_vertices = 0;  // Several fans at one vertex: one vertex each.
};

// Builds connectivity for triangles over `vertex_count` vertices. origin[v] tells which input
// vertex became vertex v: the first vertex_count are themselves, further ones are fans cut off.
// Vertices without triangles have first == kNoHalfEdge. No triangle may name a vertex twice.
HalfEdges build_half_edges(std::vector<std::uint32_t> corners, std::uint32_t vertex_count,
                           std::vector<std::uint32_t>* origin, TopologyRepairs* repairs);

}  // namespace caryatid::bake
