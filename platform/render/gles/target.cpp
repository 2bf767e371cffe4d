#include "platform/render/gles/target.h"

#include <algorithm>
#include <cmath>

namespace caryatid::platform::gles {
namespace {

bool complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

GLuint make_color_texture(GLsizei width, GLsizei height) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

void Target::destroy(Surface& surface) {
  if (surface.framebuffer != 0) glDeleteFramebuffers(1, &surface.framebuffer);
  if (surface.texture != 0) glDeleteTextures(1, &surface.texture);
  if (surface.color != 0) glDeleteRenderbuffers(1, &surface.color);
  if (surface.depth != 0) glDeleteRenderbuffers(1, &surface.depth);
  surface = {};
}

void Target::destroy() {
  destroy(scene_);
  destroy(resolved_);
  destroy(output_);
}

bool Target::create_plain(Surface& out, bool with_depth) {
  const auto w = static_cast<GLsizei>(width_), h = static_cast<GLsizei>(height_);
  out.texture = make_color_texture(w, h);
  glGenFramebuffers(1, &out.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, out.framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, out.texture, 0);
  if (with_depth) {
    glGenRenderbuffers(1, &out.depth);
    glBindRenderbuffer(GL_RENDERBUFFER, out.depth);
    const GLenum format = caps_.depth24 ? GL_DEPTH_COMPONENT24_OES : GL_DEPTH_COMPONENT16;
    glRenderbufferStorage(GL_RENDERBUFFER, format, w, h);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, out.depth);
  }
  return complete();
}

bool Target::create_multisampled() {
  // A CPU takes about three times as long for four samples: only pictures for files are worth it.
  if (caps_.software && !options_.offscreen) return false;
  const auto samples = static_cast<GLsizei>(std::min(options_.samples, caps_.max_samples));
  if (samples < 2) return false;
  const bool blit = extra_.blit_framebuffer != nullptr;
  const auto storage =
      blit ? extra_.renderbuffer_storage_multisample : extra_.renderbuffer_storage_multisample_ext;
  const auto w = static_cast<GLsizei>(width_), h = static_cast<GLsizei>(height_);
  glGenFramebuffers(1, &scene_.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, scene_.framebuffer);
  if (blit) {
    glGenRenderbuffers(1, &scene_.color);
    glBindRenderbuffer(GL_RENDERBUFFER, scene_.color);
    storage(GL_RENDERBUFFER, samples, GL_RGBA8_OES, w, h);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, scene_.color);
  } else {
    scene_.texture = make_color_texture(w, h);
    extra_.framebuffer_texture_multisample(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                                           scene_.texture, 0, samples);
  }
  glGenRenderbuffers(1, &scene_.depth);
  glBindRenderbuffer(GL_RENDERBUFFER, scene_.depth);
  storage(GL_RENDERBUFFER, samples, caps_.depth24 ? GL_DEPTH_COMPONENT24_OES : GL_DEPTH_COMPONENT16,
          w, h);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, scene_.depth);
  if (!complete()) return false;
  return !blit || create_plain(resolved_, false);
}

Status Target::create(std::uint32_t width, std::uint32_t height) {
  destroy();
  width_ = width;
  height_ = height;
  final_ = 0;
  if (!own()) return {};
  if (!create_multisampled()) {
    destroy();
    if (!create_plain(scene_, true)) return fail(RenderFault::framebuffer);
  }
  if (options_.offscreen && options_.scalable && !create_plain(output_, false))
    return fail(RenderFault::framebuffer);
  if (options_.offscreen) {
    final_ = resolved_.framebuffer != 0 ? resolved_.framebuffer : scene_.framebuffer;
    if (output_.framebuffer != 0) final_ = output_.framebuffer;
  }
  return {};
}

void Target::begin(float scale) {
  const float s = options_.scalable ? std::clamp(scale, 0.25f, 1.0f) : 1.0f;
  const auto scaled = [s](std::uint32_t size) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(s * static_cast<float>(size))));
  };
  scene_width_ = scaled(width_);
  scene_height_ = scaled(height_);
  glBindFramebuffer(GL_FRAMEBUFFER, scene_.framebuffer);
  glViewport(0, 0, static_cast<GLsizei>(scene_width_), static_cast<GLsizei>(scene_height_));
}

void Target::finish(GLuint quad_program, GLuint quad_buffer) {
  if (extra_.discard_framebuffer != nullptr) {  // Depth need not leave the tile memory.
    const GLenum attachment = own() ? GL_DEPTH_ATTACHMENT : GL_DEPTH_EXT;
    extra_.discard_framebuffer(GL_FRAMEBUFFER, 1, &attachment);
  }
  if (resolved_.framebuffer != 0) {
    const auto w = static_cast<GLint>(scene_width_), h = static_cast<GLint>(scene_height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER_NV, scene_.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER_NV, resolved_.framebuffer);
    extra_.blit_framebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  if (options_.scalable) scale_up(quad_program, quad_buffer);
}

void Target::scale_up(GLuint quad_program, GLuint quad_buffer) {
  bind_final();
  glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, resolved_.texture != 0 ? resolved_.texture : scene_.texture);
  glUseProgram(quad_program);
  const float sx = static_cast<float>(scene_width_) / static_cast<float>(width_);
  const float sy = static_cast<float>(scene_height_) / static_cast<float>(height_);
  glUniform2f(glGetUniformLocation(quad_program, "u_scale"), sx, sy);
  glBindBuffer(GL_ARRAY_BUFFER, quad_buffer);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace caryatid::platform::gles
