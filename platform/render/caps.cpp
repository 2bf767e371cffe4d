#include "platform/render/caps.h"

#include <algorithm>

namespace caryatid::platform {
namespace {

struct Limits {
  std::uint32_t gles_major, attributes, vertex_vectors, fragment_vectors, varyings;
  std::uint32_t vertex_textures, texture_size, mantissa, samples;
  bool etc1;
};

// Order of BoardGpu, from es2_minimum on.
constexpr Limits kLimits[] = {
    {2, 8, 128, 16, 8, 0, 64, 10, 0, false},         // GLES 2.0 as promised
    {2, 8, 4096, 4096, 8, 16, 2048, 23, 4, true},    // VC4
    {3, 16, 4096, 4096, 16, 16, 4096, 23, 4, true},  // V3D
    {2, 16, 304, 2048, 12, 0, 4096, 10, 4, true},    // Lima: fp16 fragments for good
    {2, 16, 1024, 1024, 16, 16, 4096, 10, 4, true},  // Panfrost T600-T720
    {2, 10, 168, 64, 8, 0, 2048, 23, 0, true},       // etnaviv pre-HALTI0, GC400 textures
};

}  // namespace

GpuCaps clamp_caps(const GpuCaps& caps, BoardGpu board) {
  if (board == BoardGpu::none) return caps;
  const Limits& limit = kLimits[static_cast<std::size_t>(board) - 1];
  GpuCaps out = caps;
  out.gles_major = std::min(out.gles_major, limit.gles_major);
  out.vertex_attributes = std::min(out.vertex_attributes, limit.attributes);
  out.vertex_vectors = std::min(out.vertex_vectors, limit.vertex_vectors);
  out.fragment_vectors = std::min(out.fragment_vectors, limit.fragment_vectors);
  out.varying_vectors = std::min(out.varying_vectors, limit.varyings);
  out.vertex_textures = std::min(out.vertex_textures, limit.vertex_textures);
  out.max_texture_size = std::min(out.max_texture_size, limit.texture_size);
  out.fragment_mantissa = std::min(out.fragment_mantissa, limit.mantissa);
  out.max_samples = std::min(out.max_samples, limit.samples);
  out.etc1 = out.etc1 && limit.etc1;
  return out;
}

}  // namespace caryatid::platform
