#pragma once
// From a posed person and a camera to a draw list, and how much each object matters in that
// picture.
#include <array>
#include <span>

#include "core/base/status.h"
#include "core/pack/view.h"
#include "core/scene/draw_list.h"

namespace caryatid::scene {

// Borrowed for the call; the draw list borrows `meshes` until the next frame.
struct ComposeJob {
  const pack::View* pack = nullptr;  // Required.
  std::span<const MeshView> meshes;  // One an object.
  std::span<const Affine> joints;    // Rest space to world, one a joint of the pack.
  Camera camera;
  Shading shading = Shading::per_pixel;
  float render_scale = 1.0f;
  face::Wrinkles wrinkles;  // Of the face that the meshes show.
  Vec3 feet_m{0};           // Between the feet; y of the floor.

  // Fills everything of the list but `patches`. Items come opaque front to back, then lashes and
  // brows, then hair, then corneas. invalid_argument: no pack, or spans that do not match it.
  // O(objects * bones). No allocation.
  Status run(DrawList* out) const;
};

// Share of one object in the picture.
struct Importance {
  float screen_px = 0.0f;       // Area of its bounding sphere on the display, clipped to it.
  float axis_closeness = 0.0f;  // 1 in the middle of the picture, 0 in its corner and beyond.
};

// Of object `object`, for a display of width x height pixels. O(1).
Importance importance(const ComposeJob& job, std::size_t object, std::uint32_t width,
                      std::uint32_t height);

}  // namespace caryatid::scene
