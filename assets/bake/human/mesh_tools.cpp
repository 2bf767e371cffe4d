#include "assets/bake/human/mesh_tools.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace caryatid::bake {
namespace {

float corner_angle(Vec3 before, Vec3 at, Vec3 after) {
  const Vec3 a = before - at, b = after - at;
  const float lengths = glm::length(a) * glm::length(b);
  if (lengths < 1e-14f) return 0;
  return std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0f, 1.0f));
}

}  // namespace

std::vector<Vec3> smooth_normals(std::span<const Quad> quads, std::span<const Vec3> position_m) {
  std::vector<Vec3> out(position_m.size(), Vec3{0});
  for (const Quad& quad : quads) {
    const auto p = [&](std::size_t k) { return position_m[quad.vertex[k % 4]]; };
    // The diagonals' cross product is the quad's mean normal, bent or not.
    const Vec3 n = glm::cross(p(2) - p(0), p(3) - p(1));
    const float length = glm::length(n);
    if (length < 1e-14f) continue;
    for (std::size_t k = 0; k < 4; ++k)
      out[quad.vertex[k]] += (corner_angle(p(k + 3), p(k), p(k + 1)) / length) * n;
  }
  for (Vec3& n : out) {
    const float length = glm::length(n);
    n = length > 1e-9f ? n / length : Vec3{0, 0, 1};
  }
  return out;
}

Mesh make_mesh(const MeshSource& source, const std::function<bool(const Quad&)>& keep) {
  Mesh out;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> slots;
  const auto slot = [&](const Quad& quad, std::size_t k) {
    const std::uint32_t vertex = quad.vertex[k];
    const auto key = std::pair(vertex, quad.uv[k]);
    const auto [found, fresh] =
        slots.emplace(key, static_cast<std::uint32_t>(out.position_m.size()));
    if (fresh) {
      out.position_m.push_back(source.position_m[vertex]);
      out.normal.push_back(source.normal[vertex]);
      const Vec2 uv = source.uv[quad.uv[k]];
      out.uv.push_back({uv.x, 1.0f - uv.y});
      out.influence.push_back(source.influence(vertex));
      out.base_vertex.push_back(source.from_base ? vertex : kNone);
    }
    return found->second;
  };
  for (const Quad& quad : source.quads) {
    if (!keep(quad)) continue;
    std::array<std::uint32_t, 4> s{};
    for (std::size_t k = 0; k < 4; ++k) s[k] = slot(quad, k);
    const auto p = [&](std::size_t k) { return source.position_m[quad.vertex[k]]; };
    const bool cut_02 = glm::distance(p(0), p(2)) <= glm::distance(p(1), p(3));
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (quad.vertex[a] != quad.vertex[b] && quad.vertex[b] != quad.vertex[c] &&
          quad.vertex[c] != quad.vertex[a])
        out.triangles.push_back({s[a], s[b], s[c]});
    };
    if (cut_02) {
      add(0, 1, 2);
      add(0, 2, 3);
    } else {
      add(0, 1, 3);
      add(1, 2, 3);
    }
  }
  return out;
}

std::vector<std::uint32_t> slot_of_base(const Mesh& mesh, std::size_t base_count) {
  std::vector<std::uint32_t> out(base_count, kNone);
  for (std::size_t i = mesh.base_vertex.size(); i-- > 0;)
    if (mesh.base_vertex[i] != kNone) out[mesh.base_vertex[i]] = static_cast<std::uint32_t>(i);
  return out;
}

std::vector<std::uint32_t> connected_pieces(std::span<const Quad> quads, std::size_t vertex_count) {
  std::vector<std::uint32_t> least(vertex_count);
  std::iota(least.begin(), least.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (least[v] != v) v = least[v] = least[least[v]];
    return v;
  };
  for (const Quad& quad : quads)
    for (const std::uint32_t v : quad.vertex) {
      const std::uint32_t a = find(v), b = find(quad.vertex[0]);
      least[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t v = 0; v < least.size(); ++v) least[v] = find(v);
  return least;
}

std::vector<std::vector<std::uint32_t>> edge_neighbours(std::span<const Quad> quads,
                                                        std::size_t vertex_count) {
  std::vector<std::vector<std::uint32_t>> out(vertex_count);
  const auto link = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b && std::find(out[a].begin(), out[a].end(), b) == out[a].end()) out[a].push_back(b);
  };
  for (const Quad& quad : quads)
    for (std::size_t k = 0; k < 4; ++k) {
      link(quad.vertex[k], quad.vertex[(k + 1) % 4]);
      link(quad.vertex[(k + 1) % 4], quad.vertex[k]);
    }
  return out;
}

std::vector<std::uint32_t> pieces_of(std::span<const Quad> quads, std::size_t vertex_count) {
  const auto neighbours = edge_neighbours(quads, vertex_count);
  std::vector<std::uint32_t> out(vertex_count, kNone), open;
  std::uint32_t piece = 0;
  for (std::uint32_t start = 0; start < vertex_count; ++start) {
    if (out[start] != kNone) continue;
    out[start] = piece;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t v = open.back();
      open.pop_back();
      for (const std::uint32_t n : neighbours[v])
        if (out[n] == kNone) out[n] = piece, open.push_back(n);
    }
    ++piece;
  }
  return out;
}

}  // namespace caryatid::bake
