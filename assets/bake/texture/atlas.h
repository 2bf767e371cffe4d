#pragma once
// The head's atlas while it is painted: for every texel the point of the skin that it shows, and
// noise to draw with. Internal to the room.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake {

// A point of the skin as the painters see it.
struct SkinPoint {
  Vec3 position_m{0}, normal{0};
  Vec2 old_uv{0};
  bool is_outer = false;  // Of the outer skin, not of the mouth's bag or the sockets.
  bool there = false;     // The texel lies in a triangle.
};

struct SkinMap {
  std::uint32_t side = 0;
  std::vector<SkinPoint> point;  // side * side
  const SkinPoint& at(std::uint32_t x, std::uint32_t y) const {
    return point[std::size_t{y} * side + x];
  }
};

inline float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// A hash of a cell of a grid, -1..1.
inline float lattice(int x, int y, int z) {
  auto h = static_cast<std::uint32_t>(x) * 374761393u + static_cast<std::uint32_t>(y) * 668265263u +
           static_cast<std::uint32_t>(z) * 1274126177u;
  h = (h ^ (h >> 13)) * 1274126177u;
  return static_cast<float>((h ^ (h >> 16)) & 0xFFFFu) / 32767.5f - 1.0f;
}

// Value noise in space, so that it has no seams; -1..1.
inline float noise(Vec3 p) {
  const Vec3 f{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  Vec3 t = p - f;
  t = t * t * (3.0f - 2.0f * t);
  const int x = static_cast<int>(f.x), y = static_cast<int>(f.y), z = static_cast<int>(f.z);
  const auto row = [&](int dy, int dz) {
    return glm::mix(lattice(x, y + dy, z + dz), lattice(x + 1, y + dy, z + dz), t.x);
  };
  return glm::mix(glm::mix(row(0, 0), row(1, 0), t.y), glm::mix(row(0, 1), row(1, 1), t.y), t.z);
}

// Calls f(x, y, barycentric weights) for the texels of a square atlas whose centres lie in a
// triangle of it.
template <class F>
void for_texels(std::uint32_t atlas_side, Vec2 a, Vec2 b, Vec2 c, F&& f) {
  const auto side = static_cast<float>(atlas_side);
  a *= side, b *= side, c *= side;
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (std::abs(area) < 1e-9f) return;
  const auto cell = [side](float v) {
    return static_cast<std::uint32_t>(std::clamp(v, 0.0f, side - 1.0f));
  };
  for (std::uint32_t y = cell(std::min({a.y, b.y, c.y}) - 1);
       y <= cell(std::max({a.y, b.y, c.y}) + 1); ++y)
    for (std::uint32_t x = cell(std::min({a.x, b.x, c.x}) - 1);
         x <= cell(std::max({a.x, b.x, c.x}) + 1); ++x) {
      const Vec2 p{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
      const float wb = ((p.x - a.x) * (c.y - a.y) - (c.x - a.x) * (p.y - a.y)) / area;
      const float wc = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / area;
      const float wa = 1.0f - wb - wc;
      if (wa >= -1e-4f && wb >= -1e-4f && wc >= -1e-4f) f(x, y, Vec3{wa, wb, wc});
    }
}

}  // namespace caryatid::bake
