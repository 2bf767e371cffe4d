#pragma once
// All that a renderer needs for one frame, in plain structs: no GL words, no callbacks.
// Lifetime: everything is borrowed and valid until the next frame begins.
#include <cstdint>
#include <span>

#include "core/base/fixed.h"
#include "core/base/limits.h"
#include "core/base/vec.h"
#include "core/face/wrinkles.h"
#include "core/mesh/vertex.h"
#include "core/scene/overlay.h"

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

// A light without distance. Linear colour, 1 lights a white matt surface to white.
struct Light {
  Vec3 direction{0, 0, 1};  // Towards the light, unit, world space.
  Vec3 color{1, 1, 1};
};

struct Camera {
  Mat4 view{1.0f};        // World to eye space: right-handed, looks along -Z.
  Mat4 projection{1.0f};  // To GL clip space, z in [-w, w].
  Vec3 position_m{0};
};

// What a fragment of the person costs; chosen by core/lod from what the GPU can do.
enum class Shading : std::uint8_t { cheapest, per_vertex, per_pixel };

// A soft dark patch on the floor where feet meet it: an ellipse that fades to its rim.
struct FloorShadow {
  Vec3 center_m{0};
  float half_width_m = 0.0f;  // Along X.
  float half_depth_m = 0.0f;  // Along Z.
  float strength = 0.0f;      // Of the centre: 0 nothing .. 1 black.
};

struct DrawList {
  Camera camera;
  Light key, fill, rim;  // Soft key, fill from the other side, rim from behind.
  Vec3 ambient_up{0.3f}, ambient_down{0.2f};
  Vec3 background_top{0.0f}, background_bottom{0.0f};  // Linear.
  float render_scale = 1.0f;  // Of the display's width and height, 0.25..1.
  Shading shading = Shading::per_pixel;
  face::Wrinkles wrinkles;  // Of skin that has a detail texture; the cheapest shading leaves them.
  FixedVector<FloorShadow, 4> floor_shadows;
  std::span<const MeshView> meshes;  // By object index.
  FixedVector<MeshPatch, kMaxObjects> patches;
  // In drawing order: opaque front to back, then alpha inside out (lashes and brows, then hair),
  // then corneas. A renderer may draw an alpha item in two passes.
  FixedVector<DrawItem, kMaxDrawItems> items;
  FixedVector<Affine, kMaxDrawItems * kMaxBonesPerDraw> bones;
  Overlay overlay;  // Set by its owner, not by ComposeJob.
};

}  // namespace caryatid::scene
