#include "platform/render/gles/textures.h"

#include <algorithm>
#include <vector>

#include "platform/render/etc1.h"

namespace caryatid::platform::gles {
namespace {

struct Level {
  std::uint32_t width, height, bytes;
};

Level level_of(const pack::Texture& texture, std::uint32_t index) {
  const std::uint32_t w = std::max(1u, static_cast<std::uint32_t>(texture.width) >> index);
  const std::uint32_t h = std::max(1u, static_cast<std::uint32_t>(texture.height) >> index);
  return {w, h, texture.format == pack::TextureFormat::etc1 ? etc1_bytes(w, h) : 2 * w * h};
}

void upload_plain(GLint target_level, const Level& level, bool alpha, const void* texels) {
  const GLenum format = alpha ? GL_RGBA : GL_RGB;
  const GLenum type = alpha ? GL_UNSIGNED_SHORT_4_4_4_4 : GL_UNSIGNED_SHORT_5_6_5;
  glTexImage2D(GL_TEXTURE_2D, target_level, static_cast<GLint>(format),
               static_cast<GLsizei>(level.width), static_cast<GLsizei>(level.height), 0, format,
               type, texels);
}

void upload_etc1(GLint target_level, const Level& level, std::span<const std::byte> blocks,
                 bool native) {
  if (native) {
    glCompressedTexImage2D(GL_TEXTURE_2D, target_level, GL_ETC1_RGB8_OES,
                           static_cast<GLsizei>(level.width), static_cast<GLsizei>(level.height), 0,
                           static_cast<GLsizei>(level.bytes), blocks.data());
    return;
  }
  std::vector<std::uint16_t> expanded(std::size_t{level.width} * level.height);  // At start only.
  decode_etc1({reinterpret_cast<const std::uint8_t*>(blocks.data()), level.bytes}, level.width,
              level.height, expanded);
  upload_plain(target_level, level, false, expanded.data());
}

void set_filter(bool mipmapped) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                  mipmapped ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
}

}  // namespace

Textures::~Textures() {
  glDeleteTextures(static_cast<GLsizei>(names_.size()), names_.data());
  glDeleteTextures(1, &white_);
}

Status Textures::create(const pack::View& pack, const GpuCaps& caps, bool base_only) {
  if (pack.textures.size() > names_.size()) return fail(RenderFault::texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);  // Rows are of 16-bit texels.
  glGenTextures(1, &white_);
  glBindTexture(GL_TEXTURE_2D, white_);
  const std::uint16_t white = 0xFFFF;
  upload_plain(0, {1, 1, 2}, true, &white);
  set_filter(false);
  for (std::size_t i = 0; i < pack.textures.size(); ++i)
    CARYATID_TRY(upload(pack, caps, static_cast<std::uint16_t>(i), !base_only));
  return {};
}

// GLES 2.0 cannot start a chain below its first level, so a partial texture is a smaller texture;
// when the rest has come it is made anew.
Status Textures::upload(const pack::View& pack, const GpuCaps& caps, std::uint16_t index,
                        bool all_levels) {
  if (index >= pack.textures.size()) return fail(RenderFault::texture, Code::invalid_argument);
  const pack::Texture& texture = pack.textures[index];
  std::uint32_t first = all_levels ? 0 : texture.base_level;
  const auto too_large = [&](std::uint32_t level) {
    const Level l = level_of(texture, level);
    return std::max(l.width, l.height) > caps.max_texture_size;
  };
  while (first + 1 < texture.level_count && too_large(first)) ++first;
  glDeleteTextures(1, &names_[index]);
  glGenTextures(1, &names_[index]);
  glBindTexture(GL_TEXTURE_2D, names_[index]);
  std::size_t at = texture.texel_offset;
  for (std::uint32_t i = 0; i < texture.level_count; ++i) {
    const Level level = level_of(texture, i);
    if (at + level.bytes > pack.texels.size()) return fail(RenderFault::texture);
    const std::span<const std::byte> bytes = pack.texels.subspan(at, level.bytes);
    at += level.bytes;
    if (i < first) continue;
    const auto target = static_cast<GLint>(i - first);
    if (texture.format == pack::TextureFormat::etc1)
      upload_etc1(target, level, bytes, caps.etc1);
    else
      upload_plain(target, level, texture.format == pack::TextureFormat::rgba4444, bytes.data());
  }
  const Level last = level_of(texture, texture.level_count - 1u);
  set_filter(texture.level_count > first + 1 && last.width == 1 && last.height == 1);
  return {};
}

}  // namespace caryatid::platform::gles
