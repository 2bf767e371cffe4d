#include "assets/bake/head/skin_edit.h"

#include <algorithm>
#include <set>

namespace caryatid::bake::foreign {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

bool has_edge(const std::array<std::uint32_t, 3>& t, std::uint32_t a, std::uint32_t b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (t[i] == a && t[(i + 1) % 3] == b) return true;
  return false;
}

}  // namespace

std::vector<bool> outside_of(const PlacedHead& head, const Chain& loop, std::uint32_t from) {
  std::set<Edge> fence;
  for (std::size_t i = 0; i < loop.size(); ++i)
    fence.insert(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
  std::map<Edge, std::vector<std::size_t>> beside;
  for (std::size_t t = 0; t < head.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      beside[std::minmax(head.triangles[t][i], head.triangles[t][(i + 1) % 3])].push_back(t);
  std::vector<bool> seen(head.triangles.size(), false);
  std::vector<std::size_t> open;
  for (std::size_t t = 0; t < head.triangles.size(); ++t)
    if (std::find(head.triangles[t].begin(), head.triangles[t].end(), from) !=
        head.triangles[t].end())
      open.push_back(t);
  while (!open.empty()) {
    const std::size_t t = open.back();
    open.pop_back();
    if (seen[t]) continue;
    seen[t] = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge = std::minmax(head.triangles[t][i], head.triangles[t][(i + 1) % 3]);
      if (!fence.contains(edge))
        for (const std::size_t other : beside[edge]) open.push_back(other);
    }
  }
  return seen;
}

void remove_triangles(PlacedHead& head, const std::vector<bool>& remove) {
  Triangles kept;
  for (std::size_t t = 0; t < head.triangles.size(); ++t)
    if (!remove[t]) kept.push_back(head.triangles[t]);
  head.triangles = std::move(kept);
}

Chain add_ring(PlacedHead& head, const Chain& loop, const std::function<Vec3(std::size_t)>& place) {
  Chain copy;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    copy.push_back(static_cast<std::uint32_t>(head.position_m.size()));
    head.position_m.push_back(place(i));
  }
  std::map<Edge, int> uses;  // Directed.
  for (const auto& t : head.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    const std::uint32_t a = loop[i], b = loop[j];
    const bool forward = uses.contains({a, b}), backward = uses.contains({b, a});
    if (forward == backward) continue;
    if (forward) {
      head.triangles.push_back({b, a, copy[i]});
      head.triangles.push_back({b, copy[i], copy[j]});
    } else {
      head.triangles.push_back({a, b, copy[j]});
      head.triangles.push_back({a, copy[j], copy[i]});
    }
  }
  return copy;
}

void add_cap(PlacedHead& head, const Chain& loop) {
  Vec3 sum{0};
  for (const std::uint32_t v : loop) sum += head.position_m[v];
  const Vec3 middle = sum / static_cast<float>(loop.size());
  const Chain ends = add_ring(head, loop, [&](std::size_t) { return middle; });
  for (auto& t : head.triangles)  // All copies are one vertex.
    for (std::uint32_t& v : t)
      if (v >= ends.front()) v = ends.front();
  std::erase_if(head.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[0] == t[2]; });
  head.position_m.resize(ends.front() + 1);
}

std::uint32_t split_edge(PlacedHead& head, std::uint32_t a, std::uint32_t b) {
  const auto middle = static_cast<std::uint32_t>(head.position_m.size());
  head.position_m.push_back(0.5f * (head.position_m[a] + head.position_m[b]));
  Triangles out;
  for (const auto& t : head.triangles) {
    if (!has_edge(t, a, b) && !has_edge(t, b, a)) {
      out.push_back(t);
      continue;
    }
    for (const std::uint32_t replaced : {a, b}) {
      auto half = t;
      for (std::uint32_t& v : half)
        if (v == replaced) v = middle;
      out.push_back(half);
    }
  }
  head.triangles = std::move(out);
  return middle;
}

}  // namespace caryatid::bake::foreign
