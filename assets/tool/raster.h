#pragma once
// Meshes drawn without a GPU: shaded flat, or as a wireframe with hidden lines removed.
#include <array>
#include <span>

#include "assets/bake/simplify/edge_collapse.h"
#include "assets/tool/picture.h"

namespace caryatid::tool {

// Triangles in pixels, the nearest of which shows. Draws at twice the size of its picture.
class Raster {
 public:
  Raster(std::uint32_t width, std::uint32_t height, bool wireframe);
  double width() const { return large_.width; }  // To draw in.
  double height() const { return large_.height; }
  // x to the right, y downwards, z towards the eye. What lies outside is cut. O(pixels covered).
  void add(const std::array<bake::Vec3d, 3>& corner);
  Picture picture() const { return halved(large_); }

 private:
  bool wireframe_;
  Picture large_;
  std::vector<double> depth_;
};

// A parallel view along -Z after a turn about Y and then X (rad), framed to a box.
struct RasterView {
  double yaw_rad = 0, pitch_rad = 0;
  bake::Vec3d center{0};
  double height = 1;  // What the picture's height shows, in units of the mesh.
};
// The view of the whole of `surface`.
RasterView whole_of(const bake::Surface& surface, double yaw_rad, double pitch_rad);

// Both sides of every triangle are drawn. O(triangles + pixels covered).
Picture draw_surface(const bake::Surface& surface, const RasterView& view, bool wireframe,
                     std::uint32_t side);

}  // namespace caryatid::tool
