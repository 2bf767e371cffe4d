#pragma once
// Meshes drawn without a GPU: shaded flat, or as a wireframe with hidden lines removed.
#include <array>
#include <span>

#include "assets/bake/simplify/edge_collapse.h"
#include "assets/tool/picture.h"

namespace caryatid::tool {

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
