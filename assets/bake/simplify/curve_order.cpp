#include "assets/bake/simplify/curve_order.h"

#include <algorithm>

namespace caryatid::bake {
namespace {

// 10 bits to every third of 30.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 16) & 0x030000FF;
  v = (v | v << 8) & 0x0300F00F;
  v = (v | v << 4) & 0x030C30C3;
  return (v | v << 2) & 0x09249249;
}

}  // namespace

std::vector<std::uint32_t> curve_order(std::span<const Vec3d> points) {
  if (points.empty()) return {};
  Vec3d low = points[0], high = low;
  for (const Vec3d& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const Vec3d size = high - low;
  const double side = std::max({size.x, size.y, size.z});
  const double cells = side > 0 ? 1023.0 / side : 0.0;
  std::vector<std::uint64_t> keys(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3d c = cells * (points[v] - low);
    const std::uint64_t code = spread(static_cast<std::uint64_t>(c.x)) |
                               spread(static_cast<std::uint64_t>(c.y)) << 1 |
                               spread(static_cast<std::uint64_t>(c.z)) << 2;
    keys[v] = code << 32 | v;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = static_cast<std::uint32_t>(keys[i]);
  return order;
}

}  // namespace caryatid::bake
