#include "assets/bake/simplify/half_edges.h"

#include <algorithm>

namespace caryatid::bake {
namespace {

// Links half-edges that run over the same two vertices in opposite directions. They are chained by
// their lower vertex, in the arrays that are there anyway: linear, and no hash whose order could
// differ between machines.
std::uint32_t link_twins(HalfEdges& mesh, std::uint32_t vertex_count) {
  const auto count = static_cast<std::uint32_t>(mesh.from.size());
  std::vector<std::uint32_t>&head = mesh.first, &next = mesh.twin;
  head.assign(vertex_count, kNoHalfEdge);
  for (std::uint32_t h = 0; h < count; ++h) {
    std::uint32_t& list = head[std::min(mesh.from[h], mesh.to(h))];
    next[h] = list;
    list = h;
  }
  std::uint32_t bad = 0;
  std::vector<std::uint64_t> sides;  // Of one lower vertex: the higher one, then the half-edge.
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    sides.clear();
    for (std::uint32_t h = head[v]; h != kNoHalfEdge;) {
      sides.push_back(std::uint64_t{std::max(mesh.from[h], mesh.to(h))} << 32 | h);
      const std::uint32_t after = next[h];
      mesh.twin[h] = kNoHalfEdge;
      h = after;
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0, j; i < sides.size(); i = j) {
      for (j = i; j < sides.size() && sides[j] >> 32 == sides[i] >> 32;) ++j;
      if (j - i < 2) continue;
      const auto g = static_cast<std::uint32_t>(sides[i]);
      const auto h = static_cast<std::uint32_t>(sides[i + 1]);
      if (j - i == 2 && mesh.from[g] != mesh.from[h]) {
        mesh.twin[g] = h;
        mesh.twin[h] = g;
      } else {
        ++bad;
      }
    }
  }
  return bad;
}

}  // namespace

std::uint32_t HalfEdges::find(std::uint32_t a, std::uint32_t b) const {
  std::uint32_t found = kNoHalfEdge;
  if (first[a] == kNoHalfEdge) return found;
  for_fan(a, [&](std::uint32_t h) {
    if (to(h) == b) found = h;
  });
  return found;
}

void HalfEdges::rewind(std::uint32_t vertex, std::uint32_t h) {
  const std::uint32_t start = h;
  while (twin[h] != kNoHalfEdge) {
    h = next_in_triangle(twin[h]);
    if (h == start) break;
  }
  first[vertex] = h;
}

HalfEdges::Collapsed HalfEdges::collapse(std::uint32_t h, std::vector<std::uint32_t>* moved) {
  const std::uint32_t keep = from[h], gone = to(h);
  Collapsed out;
  for_fan(gone, [&](std::uint32_t g) {
    from[g] = keep;
    if (moved != nullptr) moved->push_back(g);
  });
  std::uint32_t any = kNoHalfEdge;  // A half-edge that starts at `keep` and survives.
  for (const std::uint32_t side : {h, twin[h]}) {
    if (side == kNoHalfEdge) continue;
    const std::uint32_t n = next_in_triangle(side), p = prev_in_triangle(side);
    const std::uint32_t apex = from[p], a = twin[n], b = twin[p];
    if (a != kNoHalfEdge) twin[a] = b;
    if (b != kNoHalfEdge) twin[b] = a;
    // Of a and b, one starts at the apex and one at `keep`, on either side of the edge. a is the
    // outer half-edge of n and so runs apex -> from[n]; b runs from[side] -> apex.
    rewind(apex, a != kNoHalfEdge ? a : next_in_triangle(b));
    if (b != kNoHalfEdge) any = b;
    if (a != kNoHalfEdge && b == kNoHalfEdge) any = next_in_triangle(a);
    out.triangle[out.triangle_count++] = side / 3;
  }
  rewind(keep, any);
  for (std::uint32_t i = 0; i < out.triangle_count; ++i)
    for (std::uint32_t c = 0; c < 3; ++c) from[3 * out.triangle[i] + c] = kNoHalfEdge;
  first[gone] = kNoHalfEdge;
  if (moved != nullptr)
    std::erase_if(*moved, [&](std::uint32_t g) { return from[g] == kNoHalfEdge; });
  return out;
}

bool HalfEdges::link_condition(std::uint32_t h, std::vector<std::uint32_t>& scratch) const {
  const std::uint32_t a = from[h], b = to(h), t = twin[h];
  const bool border_edge = t == kNoHalfEdge;
  const bool border_a = on_border(a), border_b = on_border(b);
  if (border_a && border_b && !border_edge) return false;
  scratch.clear();
  for_ring(a, [&](std::uint32_t v) { scratch.push_back(v); });
  std::size_t ring = scratch.size(), shared = 0;
  for_ring(b, [&](std::uint32_t v) {
    if (std::find(scratch.begin(), scratch.end(), v) != scratch.end())
      ++shared;
    else
      ++ring;
  });
  // `ring` counts b itself (in a's ring) and a (not in its own: counted from b) once each.
  if (shared != (border_edge ? 1u : 2u)) return false;
  if (ring <= (border_a || border_b ? 3u : 4u)) return false;
  // The opposite edges of a removed triangle must not both be borders: its apex would be left
  // alone.
  for (const std::uint32_t side : {h, t}) {
    if (side == kNoHalfEdge) continue;
    if (twin[next_in_triangle(side)] == kNoHalfEdge && twin[prev_in_triangle(side)] == kNoHalfEdge)
      return false;
  }
  return true;
}

HalfEdges build_half_edges(std::vector<std::uint32_t> corners, std::uint32_t vertex_count,
                           std::vector<std::uint32_t>* origin, TopologyRepairs* repairs) {
  HalfEdges mesh;
  mesh.from = std::move(corners);
  mesh.twin.assign(mesh.from.size(), kNoHalfEdge);
  repairs->non_manifold_edges += link_twins(mesh, vertex_count);
  mesh.first.assign(vertex_count, kNoHalfEdge);
  origin->resize(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) (*origin)[v] = v;
  // Each fan not yet seen takes its vertex, or a new one where the vertex has a fan already.
  std::vector<bool> seen(mesh.from.size(), false);
  for (std::uint32_t h = 0; h < mesh.from.size(); ++h) {
    if (seen[h]) continue;
    std::uint32_t vertex = mesh.from[h];
    if (mesh.first[vertex] != kNoHalfEdge) {
      ++repairs->non_manifold_vertices;
      origin->push_back(vertex);
      vertex = static_cast<std::uint32_t>(mesh.first.size());
      mesh.first.push_back(kNoHalfEdge);
    }
    mesh.rewind(vertex, h);
    mesh.for_fan(vertex, [&](std::uint32_t g) {
      seen[g] = true;
      mesh.from[g] = vertex;
    });
  }
  return mesh;
}

}  // namespace caryatid::bake
