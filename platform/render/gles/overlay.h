#pragma once
// Letters, boxes and pictures over the scene: one program, one buffer, one draw call.
#include <array>

#include "platform/render/gles/gl.h"

namespace caryatid::platform::gles {

class OverlayDrawer {
 public:
  OverlayDrawer() = default;
  OverlayDrawer(const OverlayDrawer&) = delete;
  OverlayDrawer& operator=(const OverlayDrawer&) = delete;
  ~OverlayDrawer();

  // The letters' distance field; makes the buffers. Nothing is drawn before it is there.
  Status load_font(const pack::FontView& font);
  // rgb565: width * height texels, powers of two, first row on top. Replaces what was there.
  Status load_picture(std::uint16_t index, std::uint16_t width, std::uint16_t height,
                      std::span<const std::uint16_t> rgb565);
  // Draws into the bound framebuffer of width x height pixels; vertices are uploaded when the
  // overlay's version has changed. Returns the bytes uploaded.
  std::uint32_t draw(const scene::Overlay& overlay, GLuint program, std::uint32_t width,
                     std::uint32_t height);

 private:
  static constexpr std::size_t kSets = 3;
  struct Vertex {
    float x, y, u, v;
    scene::Ink ink;
    std::uint8_t threshold, sharpness, picture, reserved;
  };
  static_assert(sizeof(Vertex) == 24);

  GLuint atlas_ = 0, indices_ = 0;
  std::array<GLuint, kMaxPictures> pictures_{};
  std::array<GLuint, kSets> buffers_{};
  std::array<std::uint32_t, kSets> versions_{};
  std::size_t set_ = 0;
  std::array<Vertex, 4 * kMaxOverlayQuads> vertices_;
};

}  // namespace caryatid::platform::gles
