#include "assets/tool/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace caryatid::tool {
namespace {

using bake::Vec3d;

Vec3d turned(const Vec3d& p, const RasterView& v) {
  const double cy = std::cos(v.yaw_rad), sy = std::sin(v.yaw_rad);
  const double cx = std::cos(v.pitch_rad), sx = std::sin(v.pitch_rad);
  const Vec3d q{cy * p.x - sy * p.z, p.y, sy * p.x + cy * p.z};
  return {q.x, cx * q.y - sx * q.z, sx * q.y + cx * q.z};
}

// One triangle in pixels, z towards the eye.
class Face {
 public:
  explicit Face(const std::array<Vec3d, 3>& p) : p_(p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d a = p[(i + 1) % 3], b = p[(i + 2) % 3];
      length_[i] = std::hypot(b.x - a.x, b.y - a.y);
    }
    area_ = side(p[0], p[1], p[2]);
  }
  bool empty() const { return std::abs(area_) < 1e-9; }
  // Whether (x, y) lies inside; its depth and its distance from the nearest edge in pixels.
  bool at(double x, double y, double* depth, double* edge) const {
    *depth = 0;
    *edge = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < 3; ++i) {
      const double w = side(p_[(i + 1) % 3], p_[(i + 2) % 3], {x, y, 0}) / area_;
      if (w < 0) return false;
      *depth += w * p_[i].z;
      *edge = std::min(*edge, w * std::abs(area_) / std::max(length_[i], 1e-9));
    }
    return true;
  }

 private:
  static double side(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  std::array<Vec3d, 3> p_;
  std::array<double, 3> length_{};
  double area_ = 0;
};

std::uint8_t grey_of(const std::array<Vec3d, 3>& p) {
  const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
  const double l = glm::length(n);
  const Vec3d light{0.36, -0.48, 0.8};  // Rows count downwards.
  const double lit = l > 0 ? std::abs(dot(n, light)) / l : 0;
  return static_cast<std::uint8_t>(45 + 195 * lit);
}

}  // namespace

RasterView whole_of(const bake::Surface& surface, double yaw_rad, double pitch_rad) {
  RasterView view{yaw_rad, pitch_rad, Vec3d{0}, 1};
  Vec3d low{1e300}, high{-1e300};
  for (const Vec3d& p : surface.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  view.center = 0.5 * (low + high);
  double reach = 1e-12;
  for (const Vec3d& p : surface.position) {
    const Vec3d q = turned(p - view.center, view);
    reach = std::max({reach, std::abs(q.x), std::abs(q.y)});
  }
  view.height = 2.1 * reach;
  return view;
}

Raster::Raster(std::uint32_t width, std::uint32_t height, bool wireframe)
    : wireframe_(wireframe),
      large_(2 * width, 2 * height, wireframe ? 250 : 32),
      depth_(std::size_t{large_.width} * large_.height, -std::numeric_limits<double>::max()) {}

void Raster::add(const std::array<Vec3d, 3>& p) {
  constexpr double kHalfLine = 1.8;
  const Face face(p);
  const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y});
  if (face.empty() || x1 < 0 || y1 < 0 || x0 >= width() || y0 >= height()) return;
  const auto cut = [](double v, double size) {
    return static_cast<std::uint32_t>(std::clamp(v, 0.0, size - 1));
  };
  const std::uint8_t shade = wireframe_ ? 250 : grey_of(p);
  for (std::uint32_t y = cut(y0, height()); y <= cut(y1 + 1, height()); ++y)
    for (std::uint32_t x = cut(x0, width()); x <= cut(x1 + 1, width()); ++x) {
      double z = 0, edge = 0;
      const std::size_t at = std::size_t{y} * large_.width + x;
      if (!face.at(x + 0.5, y + 0.5, &z, &edge) || z < depth_[at]) continue;
      depth_[at] = z;
      const std::uint8_t value = wireframe_ && edge < kHalfLine ? 20 : shade;
      std::fill_n(large_.rgb.begin() + static_cast<std::ptrdiff_t>(3 * at), 3, value);
    }
}

Picture draw_surface(const bake::Surface& surface, const RasterView& view, bool wireframe,
                     std::uint32_t side) {
  Raster raster(side, side, wireframe);
  const double size = raster.width();
  for (const bake::Triangle& t : surface.triangles) {
    std::array<Vec3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d q = (size / view.height) * turned(surface.position[t[i]] - view.center, view);
      p[i] = {0.5 * size + q.x, 0.5 * size - q.y, q.z};
    }
    raster.add(p);
  }
  return raster.picture();
}

}  // namespace caryatid::tool
