#pragma once
// Where the picture is drawn: the display's framebuffer, or one of our own (no surface, or a render
// scale below 1), multisampled where the GPU can.
#include "platform/render/gles/gl.h"

namespace caryatid::platform::gles {

class Target {
 public:
  Target(const GpuCaps& caps, const Extra& extra, const RenderOptions& options)
      : caps_(caps), extra_(extra), options_(options) {}
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  ~Target() { destroy(); }

  // (Re)makes the framebuffers. unsupported (framebuffer).
  Status create(std::uint32_t width, std::uint32_t height);
  // Binds and sets the viewport for a scene at `scale` of the size.
  void begin(float scale);
  // Ends the scene: resolves, scales up, leaves the finished picture in the final framebuffer.
  // `quad_program` draws a 0..1 quad that samples unit 0 (see shaders.h).
  void finish(GLuint quad_program, GLuint quad_buffer);
  void bind_final() const { glBindFramebuffer(GL_FRAMEBUFFER, final_); }

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  struct Surface {
    GLuint framebuffer = 0, texture = 0, color = 0, depth = 0;
  };
  bool own() const { return options_.offscreen || options_.scalable; }
  bool create_plain(Surface& out, bool with_depth);
  bool create_multisampled();
  static void destroy(Surface& surface);
  void destroy();
  void scale_up(GLuint quad_program, GLuint quad_buffer);

  const GpuCaps& caps_;
  const Extra& extra_;
  const RenderOptions& options_;
  std::uint32_t width_ = 0, height_ = 0;
  std::uint32_t scene_width_ = 0, scene_height_ = 0;  // At the present scale.
  Surface scene_;     // Drawn on. Multisampled: renderbuffers without texture, or EXT texture.
  Surface resolved_;  // One sample; only when scene_ has no texture.
  Surface output_;    // Full size; only for offscreen and scalable together.
  GLuint final_ = 0;
};

}  // namespace caryatid::platform::gles
