#include "assets/bake/simplify/error_bound.h"

#include <algorithm>

#include "assets/bake/simplify/distance.h"

namespace caryatid::bake {

Surface coarsest_within(const History& history, const Surface& original, double bound,
                        std::uint32_t least, const std::function<void(std::uint32_t)>& watch) {
  const SurfaceTree tree(original);
  HistoryCursor cursor(history);
  const auto holds = [&](std::uint32_t faces) {
    cursor.go_to(faces);
    if (watch) watch(cursor.triangle_count());
    const Surface level = cursor.surface();
    if (one_sided(level, tree, 10, 2).max > bound) return false;
    return one_sided(original, SurfaceTree(level), 10, 1).max <= bound;
  };
  auto low = std::max(least, static_cast<std::uint32_t>(history.base.triangles.size()));
  std::uint32_t high = history.max_triangles();
  if (low >= high || holds(low)) {
    cursor.go_to(low);
    return cursor.surface();
  }
  while (high - low > 2) {
    const std::uint32_t middle = low + (high - low) / 2;
    (holds(middle) ? high : low) = middle;
  }
  while (!holds(high) && high < history.max_triangles()) high += 2;
  cursor.go_to(high);
  return cursor.surface();
}

}  // namespace caryatid::bake
