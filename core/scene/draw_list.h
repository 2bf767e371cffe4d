#pragma once
// All that a renderer needs for one frame, in plain structs: no GL words, no callbacks.
// Lifetime: everything is borrowed and valid until the next frame begins.
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/vec.h"
#include "core/mesh/vertex.h"

namespace caryatid::scene {

using mesh::DirtyRange;
using mesh::DynamicVertex;
using mesh::StaticVertex;

// The live mesh of one object: buffers of fixed capacity of which a prefix is in use.
struct MeshView {
  std::span<const DynamicVertex> dynamic;  // [0, vertex_count) live
  std::span<const StaticVertex> fixed;
  std::span<const std::uint16_t> indices;  // Triangle list, 3 * triangle_count live
  std::uint32_t vertex_count = 0;
  std::uint32_t triangle_count = 0;
};

// Ranges that differ from the frame before; the renderer uploads just these.
struct MeshPatch {
  std::uint16_t object = 0;            // Index of the object in the pack.
  DirtyRange dynamic, fixed, indices;  // In elements.
};

struct DrawItem {
  std::uint16_t object = 0;    // MeshView to draw.
  std::uint16_t material = 0;  // Index into the pack's materials.
  std::uint32_t triangle_count = 0;
  std::uint16_t first_bone = 0;  // Slice of DrawList::bones.
  std::uint16_t bone_count = 0;
};

// Light of the kiosk: a soft key, a fill, a rim, and an ambient from above and below. Linear
// colour.
struct Light {
  Vec3 direction{0, 0, 1};  // Towards the light, unit, world space.
  Vec3 color{1, 1, 1};
};

struct Camera {
  Mat4 view{1.0f};
  Mat4 projection{1.0f};
  Vec3 position_m{0};
};

enum class Shading : std::uint8_t { cheapest, per_vertex, per_pixel };

struct DrawList {
  Camera camera;
  Light key, fill, rim;
  Vec3 ambient_up{0.3f}, ambient_down{0.2f};
  Vec3 background_top{0.0f}, background_bottom{0.0f};  // Linear.
  float render_scale = 1.0f;                           // Of the display's width and height.
  Shading shading = Shading::per_pixel;
  std::span<const MeshView> meshes;  // By object index.
  FixedVector<MeshPatch, kMaxObjects> patches;
  FixedVector<DrawItem, kMaxDrawItems>
      items;  // In drawing order: opaque front to back, then alpha.
  FixedVector<Affine, kMaxDrawItems * kMaxBonesPerDraw> bones;
};

}  // namespace caryatid::scene
