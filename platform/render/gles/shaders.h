#pragma once
// The programs: one for each kind of material, shading tier and alpha pass that the pack needs, all
// compiled at start. Sources are GLSL ES 1.00 and written for mediump fragments of 10 bits.
#include <array>
#include <cstdint>

#include "platform/render/gles/gl.h"

namespace caryatid::platform::gles {

enum Attribute : GLuint { kPosition, kNormal, kUv, kBone, kWeight, kAttributeCount };

// How a draw treats alpha: not at all, only what is nearly opaque (writes depth), only the soft
// edge around that (blended), or added light on top (cornea).
enum class Pass : std::uint8_t { opaque, core, edge, glint };
// A kind of program: pack::MaterialKind, or skin that has lines.
inline constexpr std::size_t kPassCount = 4, kKindCount = 7, kTierCount = 3;
inline constexpr std::size_t kLinedSkin = 6;
std::size_t program_kind(const pack::Material& material);

struct Program {
  GLuint name = 0;
  GLint bones = -1, view_projection = -1, eye = -1;
  GLint key_direction = -1, key_color = -1, fill_direction = -1, fill_color = -1;
  GLint rim_direction = -1, rim_color = -1, ambient_up = -1, ambient_down = -1;
  GLint tint = -1, surface = -1, wrinkles = -1;
  std::uint32_t frame = 0;  // Frame for which its camera and lights are set.
};

class Programs {
 public:
  Programs() = default;
  Programs(const Programs&) = delete;
  Programs& operator=(const Programs&) = delete;
  ~Programs();

  // Compiles what `pack` needs. unsupported (program) with the driver's first line in `out_error`.
  Status create(const pack::View& pack, ErrorLine& out_error);
  Program& scene(const pack::Material& material, scene::Shading tier, Pass pass) {
    return scene_[program_kind(material)][static_cast<std::size_t>(tier)]
                 [static_cast<std::size_t>(pass)];
  }
  GLuint quad() const { return quad_; }                  // u_scale; samples unit 0
  GLuint background() const { return background_; }      // u_top, u_bottom: sRGB
  GLuint floor_shadow() const { return floor_shadow_; }  // u_view_projection, u_center, u_half
  GLuint overlay() const { return overlay_; }            // u_place, u_picture
  // One program by itself, with every attribute bound and texture unit 0 in u_texture; 0 with the
  // driver's first line in `out_error`. The caller deletes it.
  static GLuint make(const char* vertex, const char* fragment, ErrorLine& out_error);

 private:
  Program scene_[kKindCount][kTierCount][kPassCount];
  GLuint quad_ = 0, background_ = 0, floor_shadow_ = 0, overlay_ = 0;
};

// The passes that a material is drawn in: one, or core and edge.
bool needs_pass(const pack::Material& material, Pass pass);

}  // namespace caryatid::platform::gles
