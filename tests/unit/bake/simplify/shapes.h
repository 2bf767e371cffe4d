#pragma once
// Small surfaces for tests and benchmarks.
#include <cmath>
#include <numbers>

#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bake {

// rows x columns squares in the plane z = bump * f(x, y), open.
inline Surface grid(std::uint32_t rows, std::uint32_t columns, double bump) {
  Surface s;
  for (std::uint32_t r = 0; r <= rows; ++r)
    for (std::uint32_t c = 0; c <= columns; ++c) {
      const double x = c, y = r;
      s.position.push_back({x, y, bump * std::sin(0.7 * x) * std::cos(0.5 * y)});
    }
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
      s.triangles.push_back({a, a + 1, b + 1});
      s.triangles.push_back({a, b + 1, b});
    }
  return s;
}

// A closed ball with waves of the given height: rows between poles, 2 * rows columns.
inline Surface ball(std::uint32_t rows, double waves) {
  Surface s;
  const std::uint32_t columns = 2 * rows;
  s.position.push_back({0, 1, 0});
  for (std::uint32_t r = 1; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double t = std::numbers::pi * r / rows, p = 2 * std::numbers::pi * c / columns;
      const double radius = 1 + waves * std::sin(5 * p) * std::sin(4 * t) * std::sin(t);
      s.position.push_back({radius * std::sin(t) * std::sin(p), radius * std::cos(t),
                            radius * std::sin(t) * std::cos(p)});
    }
  s.position.push_back({0, -1, 0});
  const auto at = [&](std::uint32_t r, std::uint32_t c) {
    return r == 0      ? 0u
           : r == rows ? static_cast<std::uint32_t>(s.position.size() - 1)
                       : 1 + (r - 1) * columns + c % columns;
  };
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      if (r + 1 < rows) s.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      if (r > 0) s.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
  return s;
}

}  // namespace caryatid::bake
