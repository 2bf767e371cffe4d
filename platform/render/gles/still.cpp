#include <array>

#include "platform/render/gles/gl.h"
#include "platform/render/gles/shader_text.h"
#include "platform/render/gles/shaders.h"

namespace caryatid::platform {
namespace {

using gles::fail;

struct Corner {
  float x, y, u, v;
};

// The display's corners and where in the picture they lie.
std::array<Corner, 4> corners(const Still& still, std::uint32_t display_width,
                              std::uint32_t display_height, std::uint32_t turn_degrees) {
  const std::uint32_t quarter = turn_degrees / 90 % 4;
  const auto w = static_cast<float>(quarter % 2 == 0 ? display_width : display_height);
  const auto h = static_cast<float>(quarter % 2 == 0 ? display_height : display_width);
  const float half_u = 0.5f * (w / h) * static_cast<float>(still.height) / still.width;
  constexpr float kCos[4] = {1, 0, -1, 0}, kSin[4] = {0, 1, 0, -1};
  std::array<Corner, 4> out{};
  for (std::size_t c = 0; c < 4; ++c) {
    const float right = c % 2 != 0 ? 1.0f : -1.0f, up = c / 2 != 0 ? 1.0f : -1.0f;
    out[c] = {kCos[quarter] * right + kSin[quarter] * up,
              kCos[quarter] * up - kSin[quarter] * right, 0.5f + half_u * right, 0.5f - 0.5f * up};
  }
  return out;
}

GLuint upload(const Still& still) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, still.width, still.height, 0, GL_RGB,
               GL_UNSIGNED_SHORT_5_6_5, still.rgb565.data());
  return texture;
}

}  // namespace

Status draw_still(const Still& still, std::uint32_t display_width, std::uint32_t display_height,
                  std::uint32_t turn_degrees) {
  if (still.width == 0 || still.rgb565.size() < std::size_t{still.width} * still.height ||
      display_height == 0 || display_width == 0)
    return fail(RenderFault::texture, Code::invalid_argument);
  ErrorLine ignored;
  const GLuint program = gles::Programs::make(gles::kStillVertex, gles::kQuadFragment, ignored);
  if (program == 0) return fail(RenderFault::program);
  const GLuint texture = upload(still);
  const auto quad = corners(still, display_width, display_height, turn_degrees);
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, sizeof quad, quad.data(), GL_STATIC_DRAW);
  glViewport(0, 0, static_cast<GLsizei>(display_width), static_cast<GLsizei>(display_height));
  glClear(GL_COLOR_BUFFER_BIT);  // Spares a tiler from loading what is drawn over.
  glUseProgram(program);
  for (const GLuint a : {gles::kPosition, gles::kUv}) glEnableVertexAttribArray(a);
  glVertexAttribPointer(gles::kPosition, 2, GL_FLOAT, GL_FALSE, sizeof(Corner), nullptr);
  glVertexAttribPointer(gles::kUv, 2, GL_FLOAT, GL_FALSE, sizeof(Corner),
                        reinterpret_cast<const void*>(std::size_t{8}));
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glFinish();
  for (const GLuint a : {gles::kPosition, gles::kUv}) glDisableVertexAttribArray(a);
  glDeleteBuffers(1, &buffer);
  glDeleteTextures(1, &texture);
  glDeleteProgram(program);
  return glGetError() == GL_NO_ERROR ? Status{} : fail(RenderFault::memory, Code::out_of_capacity);
}

}  // namespace caryatid::platform
