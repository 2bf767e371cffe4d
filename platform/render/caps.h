#pragma once
// What the GPU can do, as data: the renderer reports it, quality selection reads it, tests clamp
// it.
#include <cstdint>

#include "core/base/fixed.h"

namespace caryatid::platform {

struct GpuCaps {
  FixedString<95> renderer, version;     // GL_RENDERER, GL_VERSION.
  std::uint32_t gles_major = 2;          // 2 or 3.
  std::uint32_t vertex_attributes = 8;   // Minima of GLES 2.0 from here on.
  std::uint32_t vertex_vectors = 128;    // Uniform vec4 of the vertex shader.
  std::uint32_t fragment_vectors = 16;   // Uniform vec4 of the fragment shader.
  std::uint32_t varying_vectors = 8;     // vec4 from vertex to fragment shader.
  std::uint32_t vertex_textures = 0;     // Texture units of the vertex shader.
  std::uint32_t max_texture_size = 64;   // Texels a side.
  std::uint32_t fragment_mantissa = 10;  // Bits of mediump in fragment shaders.
  std::uint32_t max_samples = 0;         // Of offscreen multisampling; 0: none.
  std::uint64_t extensions_hash = 0;     // Of the extension string, for bug reports.
  bool etc1 = false;                     // Compressed textures as they are; else expanded to 565.
  bool depth24 = false;                  // Offscreen depth of 24 bits; else 16.
  bool discard = false;                  // EXT_discard_framebuffer or GLES 3.
  bool timer = false;                    // EXT_disjoint_timer_query.
  bool software = false;                 // llvmpipe, softpipe, swrast: no GPU behind it.
};

// The limits that this project draws within; every GPU of the table below keeps them.
inline constexpr std::uint32_t kVertexVectorsUsed = 114;  // 30 bones of 3, 24 for the rest.

// Boards whose limits tests can take on: the columns of GLES limits in Mesa's drivers.
enum class BoardGpu : std::uint8_t { none, es2_minimum, vc4, v3d, lima, panfrost, etnaviv };

// `caps` with nothing above what the board offers. Rendering under it takes the paths that the
// board would. Source: Mesa driver sources (vc4_screen.c, v3d_limits.h, lima_screen.c,
// etnaviv_screen.c), the smaller value where cores differ.
GpuCaps clamp_caps(const GpuCaps& caps, BoardGpu board);

}  // namespace caryatid::platform
