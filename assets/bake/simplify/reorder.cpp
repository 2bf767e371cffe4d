#include "assets/bake/simplify/cache_order.h"
#include "assets/bake/simplify/object_history.h"

namespace caryatid::bake {
namespace {

// A reorder costs time in proportion to all live triangles when the level crosses it, and two bytes
// a triangle in the pack: a quarter keeps both small beside the splits themselves.
constexpr double kGrowth = 1.25;

}  // namespace

void add_reorders(ObjectHistory* history) {
  TriangleList live = history->base_triangles;
  std::vector<std::uint32_t> place(
      history->max_triangle_count);  // Of each triangle, by its number.
  for (std::uint32_t t = 0; t < live.size(); ++t) place[t] = t;
  std::vector<SplitRecord> out;
  std::uint32_t vertices = history->base_vertex_count;
  auto next = static_cast<std::size_t>(kGrowth * static_cast<double>(live.size()));
  const auto reorder = [&] {
    SplitRecord record;
    record.reordered = cache_order(live, vertices);
    std::vector<std::uint32_t> moved_to(live.size());
    TriangleList sorted;
    for (const std::uint32_t from : record.reordered) {
      moved_to[from] = static_cast<std::uint32_t>(sorted.size());
      sorted.push_back(live[from]);
    }
    for (std::uint32_t t = 0; t < live.size(); ++t) place[t] = moved_to[place[t]];
    live = std::move(sorted);
    out.push_back(std::move(record));
    next = static_cast<std::size_t>(kGrowth * static_cast<double>(live.size()));
  };
  for (SplitRecord& split : history->splits) {
    for (std::uint32_t& t : split.moved) {
      t = place[t];
      for (std::uint32_t& corner : live[t])
        for (std::size_t a = 0; a < split.added.size(); ++a)
          if (corner == split.added[a].parent) {
            corner = vertices + static_cast<std::uint32_t>(a);
            break;
          }
    }
    vertices += static_cast<std::uint32_t>(split.added.size());
    for (const auto& t : split.triangles) {
      place[live.size()] = static_cast<std::uint32_t>(live.size());
      live.push_back(t);
    }
    const bool last = &split == &history->splits.back();
    out.push_back(std::move(split));
    if (live.size() >= next || last) reorder();
  }
  history->splits = std::move(out);
}

}  // namespace caryatid::bake
