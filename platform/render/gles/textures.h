#pragma once
#include <array>

#include "core/base/limits.h"
#include "platform/render/gles/gl.h"

namespace caryatid::platform::gles {

// The pack's textures on the GPU, and a white texel for materials without one.
class Textures {
 public:
  Textures() = default;
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;
  ~Textures();

  // Loads all textures: whole, or from base_level on. unsupported (texture): more than kMaxTextures
  // or levels that lie outside `texels`.
  Status create(const pack::View& pack, const GpuCaps& caps, bool base_only);
  // Replaces one texture's levels.
  Status upload(const pack::View& pack, const GpuCaps& caps, std::uint16_t texture,
                bool all_levels);
  GLuint name(std::uint16_t texture) const {
    return texture < names_.size() && names_[texture] != 0 ? names_[texture] : white_;
  }

 private:
  std::array<GLuint, kMaxTextures> names_{};
  GLuint white_ = 0;
};

}  // namespace caryatid::platform::gles
