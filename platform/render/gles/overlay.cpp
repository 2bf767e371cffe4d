#include "platform/render/gles/overlay.h"

#include <algorithm>
#include <vector>

#include "platform/render/gles/shaders.h"

namespace caryatid::platform::gles {
namespace {

GLuint make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return name;
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

OverlayDrawer::~OverlayDrawer() {
  glDeleteTextures(1, &atlas_);
  glDeleteTextures(static_cast<GLsizei>(pictures_.size()), pictures_.data());
  glDeleteBuffers(1, &indices_);
  glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
}

Status OverlayDrawer::load_font(const pack::FontView& font) {
  if (atlas_ != 0) return fail(RenderFault::texture, Code::invalid_argument);
  atlas_ = make_texture();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, font.header->atlas_width, font.header->atlas_height, 0,
               GL_ALPHA, GL_UNSIGNED_BYTE, font.atlas.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  std::vector<std::uint16_t> indices;  // At start only.
  for (std::uint32_t q = 0; q < kMaxOverlayQuads; ++q)
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u})
      indices.push_back(static_cast<std::uint16_t>(4 * q + corner));
  glGenBuffers(1, &indices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * 2), indices.data(),
               GL_STATIC_DRAW);
  glGenBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  for (const GLuint buffer : buffers_) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, sizeof vertices_, nullptr, GL_DYNAMIC_DRAW);
  }
  return glGetError() == GL_NO_ERROR ? Status{} : fail(RenderFault::memory, Code::out_of_capacity);
}

Status OverlayDrawer::load_picture(std::uint16_t index, std::uint16_t width, std::uint16_t height,
                                   std::span<const std::uint16_t> rgb565) {
  if (index >= pictures_.size() || rgb565.size() < std::size_t{width} * height)
    return fail(RenderFault::texture, Code::invalid_argument);
  glDeleteTextures(1, &pictures_[index]);
  pictures_[index] = make_texture();
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, width, height, 0, GL_RGB, GL_UNSIGNED_SHORT_5_6_5,
               rgb565.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glGenerateMipmap(GL_TEXTURE_2D);
  return glGetError() == GL_NO_ERROR ? Status{} : fail(RenderFault::memory, Code::out_of_capacity);
}

std::uint32_t OverlayDrawer::draw(const scene::Overlay& overlay, GLuint program,
                                  std::uint32_t width, std::uint32_t height) {
  const std::size_t count = std::min(overlay.quads.size(), kMaxOverlayQuads);
  if (atlas_ == 0 || count == 0 || overlay.width <= 0.0f || overlay.height <= 0.0f) return 0;
  std::uint32_t uploaded = 0;
  if (versions_[set_] != overlay.version) {
    set_ = (set_ + 1) % kSets;
    versions_[set_] = overlay.version;
    for (std::size_t q = 0; q < count; ++q) {
      const scene::OverlayQuad& quad = overlay.quads[q];
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const bool right = corner % 2 != 0, low = corner / 2 != 0;
        vertices_[4 * q + corner] = {right ? quad.at.x1 : quad.at.x0,
                                     low ? quad.at.y1 : quad.at.y0,
                                     right ? quad.u1 : quad.u0,
                                     low ? quad.v1 : quad.v0,
                                     quad.ink,
                                     quad.threshold,
                                     quad.sharpness,
                                     static_cast<std::uint8_t>(quad.is_picture != 0 ? 255 : 0),
                                     0};
      }
    }
    uploaded = static_cast<std::uint32_t>(4 * count * sizeof(Vertex));
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[set_]);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(uploaded), vertices_.data());
  }
  glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  glUseProgram(program);
  constexpr float kCos[4] = {1, 0, -1, 0}, kSin[4] = {0, 1, 0, -1};
  const std::uint32_t quarter = overlay.turn_degrees / 90 % 4;
  glUniform4f(glGetUniformLocation(program, "u_place"), 2.0f / overlay.width, 2.0f / overlay.height,
              kCos[quarter], kSin[quarter]);
  glUniform1i(glGetUniformLocation(program, "u_picture"), 1);
  glActiveTexture(GL_TEXTURE1);
  const GLuint picture =
      overlay.picture < pictures_.size() ? pictures_[overlay.picture] : GLuint{0};
  glBindTexture(GL_TEXTURE_2D, picture != 0 ? picture : atlas_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, atlas_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[set_]);
  for (const GLuint a : {kPosition, kUv, kNormal, kBone}) glEnableVertexAttribArray(a);
  glDisableVertexAttribArray(kWeight);
  constexpr GLsizei kStride = sizeof(Vertex);
  glVertexAttribPointer(kPosition, 2, GL_FLOAT, GL_FALSE, kStride, offset(0));
  glVertexAttribPointer(kUv, 2, GL_FLOAT, GL_FALSE, kStride, offset(8));
  glVertexAttribPointer(kNormal, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, offset(16));
  glVertexAttribPointer(kBone, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, offset(20));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * count), GL_UNSIGNED_SHORT, nullptr);
  glDisable(GL_BLEND);
  return uploaded;
}

}  // namespace caryatid::platform::gles
