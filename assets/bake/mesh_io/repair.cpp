#include "assets/bake/mesh_io/repair.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace caryatid::bake {
namespace {

void weld(Surface* s, RepairReport* report) {
  std::vector<std::uint32_t> order(s->position.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    // -0 and 0 are one place.
    const Vec3d p = s->position[v] + 0.0;
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<std::uint32_t> first(s->position.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  for (Triangle& t : s->triangles)
    for (std::uint32_t& v : t) v = first[v];
  for (std::uint32_t v = 0; v < first.size(); ++v) report->duplicate_vertices += first[v] != v;
  report->vertex_of_input = std::move(first);
}

bool on_a_line(const Surface& s, const Triangle& t) {
  const Vec3d &a = s.position[t[0]], &b = s.position[t[1]], &c = s.position[t[2]];
  const double longest = std::max({length2(b - a), length2(c - b), length2(a - c)});
  const double area2 = length2(cross(b - a, c - a));
  return !(area2 > 1e-28 * longest * longest);
}

void drop_triangles(Surface* s, RepairReport* report) {
  const std::size_t before = s->triangles.size();
  std::erase_if(s->triangles, [&](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || on_a_line(*s, t);
  });
  report->degenerate_triangles = static_cast<std::uint32_t>(before - s->triangles.size());
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  for (std::uint32_t t = 0; t < s->triangles.size(); ++t) {
    Triangle k = s->triangles[t];
    std::sort(k.begin(), k.end());
    sorted.push_back({k, t});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> drop(sorted.size(), false);
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first) drop[sorted[i].second] = true;
  std::uint32_t i = 0;
  report->duplicate_triangles = static_cast<std::uint32_t>(
      std::erase_if(s->triangles, [&](const Triangle&) { return drop[i++]; }));
}

// Triangles that share an edge with just one other should pass it in opposite directions. Each
// component is turned to what most of its triangles say.
void orient(Surface* s, RepairReport* report) {
  struct Side {
    std::uint32_t low, high, triangle;
    bool forward;
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < s->triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = s->triangles[t][i], b = s->triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> across(s->triangles.size());
  for (std::size_t i = 0, j; i < sides.size(); i = j) {
    for (j = i; j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high;)
      ++j;
    if (j - i != 2) continue;
    const bool agree = sides[i].forward != sides[i + 1].forward;
    across[sides[i].triangle].push_back({sides[i + 1].triangle, agree});
    across[sides[i + 1].triangle].push_back({sides[i].triangle, agree});
  }
  std::vector<int> turn(s->triangles.size(), 0);  // 1 as it is, -1 the other way round.
  for (std::uint32_t seed = 0; seed < turn.size(); ++seed) {
    if (turn[seed] != 0) continue;
    std::vector<std::uint32_t> component = {seed};
    turn[seed] = 1;
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < component.size(); ++i) {
      sum += turn[component[i]];
      for (const auto& [other, agree] : across[component[i]]) {
        if (turn[other] != 0) continue;
        turn[other] = agree ? turn[component[i]] : -turn[component[i]];
        component.push_back(other);
      }
    }
    for (const std::uint32_t t : component)
      if ((turn[t] < 0) == (sum >= 0)) {
        std::swap(s->triangles[t][1], s->triangles[t][2]);
        ++report->flipped_triangles;
      }
  }
}

void drop_vertices(Surface* s, RepairReport* report) {
  std::vector<std::uint32_t> number(s->position.size(), kNoHalfEdge);
  for (const Triangle& t : s->triangles)
    for (const std::uint32_t v : t) number[v] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNoHalfEdge) {
      report->unreferenced_vertices += report->vertex_of_input[v] == v;
      continue;
    }
    s->position[count] = s->position[v];
    number[v] = count++;
  }
  s->position.resize(count);
  for (Triangle& t : s->triangles)
    for (std::uint32_t& v : t) v = number[v];
  for (std::uint32_t& v : report->vertex_of_input) v = number[v];
}

// Cuts open what is no surface: the fans of half_edges.h become vertices of their own.
void cut(Surface* s, RepairReport* report) {
  std::vector<std::uint32_t> corners, origin;
  for (const Triangle& t : s->triangles) corners.insert(corners.end(), t.begin(), t.end());
  const HalfEdges mesh =
      build_half_edges(std::move(corners), static_cast<std::uint32_t>(s->position.size()), &origin,
                       &report->topology);
  for (std::size_t v = s->position.size(); v < origin.size(); ++v)
    s->position.push_back(s->position[origin[v]]);
  for (std::size_t h = 0; h < mesh.from.size(); ++h) s->triangles[h / 3][h % 3] = mesh.from[h];
}

}  // namespace

std::string RepairReport::text() const {
  std::string out;
  const auto say = [&out](std::uint32_t n, const char* what) {
    if (n > 0) out += (out.empty() ? "" : ", ") + std::to_string(n) + " " + what;
  };
  say(duplicate_vertices, "duplicate vertices welded");
  say(unreferenced_vertices, "unreferenced vertices dropped");
  say(degenerate_triangles, "degenerate faces dropped");
  say(duplicate_triangles, "duplicate faces dropped");
  say(flipped_triangles, "faces turned round");
  say(topology.non_manifold_edges, "non-manifold edges cut open");
  say(topology.non_manifold_vertices, "non-manifold vertices split");
  return out;
}

Surface repair_surface(Surface surface, RepairReport* report) {
  *report = {};
  weld(&surface, report);
  drop_triangles(&surface, report);
  orient(&surface, report);
  drop_vertices(&surface, report);
  cut(&surface, report);
  return surface;
}

SurfaceFacts facts_of(const Surface& s) {
  SurfaceFacts out;
  if (s.position.empty()) return out;
  std::vector<std::uint32_t> corners, origin;
  for (const Triangle& t : s.triangles) corners.insert(corners.end(), t.begin(), t.end());
  TopologyRepairs unused;
  const HalfEdges mesh = build_half_edges(
      std::move(corners), static_cast<std::uint32_t>(s.position.size()), &origin, &unused);
  out.vertices = static_cast<std::uint32_t>(mesh.first.size());
  out.triangles = static_cast<std::uint32_t>(s.triangles.size());
  std::int64_t edges = 0;
  std::vector<std::uint32_t> root(mesh.first.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&root](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  std::map<std::uint32_t, std::uint32_t> border_next;
  for (std::uint32_t h = 0; h < mesh.from.size(); ++h) {
    root[find(mesh.from[h])] = find(mesh.to(h));
    const bool border = mesh.twin[h] == kNoHalfEdge;
    edges += border || h < mesh.twin[h];
    if (!border) continue;
    ++out.border_edges;
    border_next[mesh.from[h]] = mesh.to(h);
    out.border_length +=
        glm::length(s.position[origin[mesh.to(h)]] - s.position[origin[mesh.from[h]]]);
  }
  for (std::uint32_t v = 0; v < root.size(); ++v)
    out.components += mesh.first[v] != kNoHalfEdge && find(v) == v;
  std::set<std::uint32_t> seen;
  for (const auto& [v, next] : border_next) {
    if (seen.count(v) != 0) continue;
    ++out.border_loops;
    for (std::uint32_t w = v; seen.insert(w).second;) w = border_next[w];
  }
  out.euler = static_cast<std::int64_t>(out.vertices) - edges + out.triangles;
  Vec3d low = s.position[0], high = low;
  for (const Vec3d& p : s.position) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const Vec3d middle = 0.5 * (low + high);
  out.diagonal = glm::length(high - low);
  for (const Triangle& t : s.triangles)
    out.volume += dot(cross(s.position[t[0]] - middle, s.position[t[1]] - middle),
                      s.position[t[2]] - middle) /
                  6;
  return out;
}

}  // namespace caryatid::bake
