#include <algorithm>
#include <cstring>

#include "core/base/crc.h"
#include "platform/render/gles/gl.h"

namespace caryatid::platform::gles {
namespace {

const char* text_of(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text != nullptr ? text : "";
}

std::uint32_t number(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return static_cast<std::uint32_t>(std::max(value, 0));
}

bool has(const char* extensions, const char* name) {
  const char* at = std::strstr(extensions, name);
  return at != nullptr && (at[std::strlen(name)] == ' ' || at[std::strlen(name)] == '\0');
}

template <class F>
void load(GlProc (*proc_address)(const char*), const char* name, F& out) {
  out = proc_address != nullptr ? reinterpret_cast<F>(proc_address(name)) : nullptr;
}

void load_extra(const char* extensions, bool gles3, GlProc (*proc)(const char*), Extra& out) {
  if (gles3) {
    load(proc, "glRenderbufferStorageMultisample", out.renderbuffer_storage_multisample);
    load(proc, "glBlitFramebuffer", out.blit_framebuffer);
    load(proc, "glInvalidateFramebuffer", out.discard_framebuffer);
  }
  if (has(extensions, "GL_EXT_multisampled_render_to_texture")) {
    load(proc, "glFramebufferTexture2DMultisampleEXT", out.framebuffer_texture_multisample);
    load(proc, "glRenderbufferStorageMultisampleEXT", out.renderbuffer_storage_multisample_ext);
  }
  if (out.discard_framebuffer == nullptr && has(extensions, "GL_EXT_discard_framebuffer"))
    load(proc, "glDiscardFramebufferEXT", out.discard_framebuffer);
  if (has(extensions, "GL_EXT_robustness"))
    load(proc, "glGetGraphicsResetStatusEXT", out.reset_status);
}

}  // namespace

GpuCaps query_caps(BoardGpu clamp, GlProc (*proc_address)(const char*), Extra& out_extra) {
  GpuCaps caps;
  const char* renderer = text_of(GL_RENDERER);
  const char* version = text_of(GL_VERSION);
  const char* extensions = text_of(GL_EXTENSIONS);
  caps.renderer.assign({renderer, std::strlen(renderer)});
  caps.version.assign({version, std::strlen(version)});
  caps.extensions_hash = hash_of(std::span<const char>{extensions, std::strlen(extensions)});
  caps.gles_major = std::strstr(version, "OpenGL ES 3") != nullptr ? 3 : 2;
  caps.vertex_attributes = number(GL_MAX_VERTEX_ATTRIBS);
  caps.vertex_vectors = number(GL_MAX_VERTEX_UNIFORM_VECTORS);
  caps.fragment_vectors = number(GL_MAX_FRAGMENT_UNIFORM_VECTORS);
  caps.varying_vectors = number(GL_MAX_VARYING_VECTORS);
  caps.vertex_textures = number(GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS);
  caps.max_texture_size = number(GL_MAX_TEXTURE_SIZE);
  GLint range[2] = {0, 0}, mantissa = 0;
  glGetShaderPrecisionFormat(GL_FRAGMENT_SHADER, GL_MEDIUM_FLOAT, range, &mantissa);
  caps.fragment_mantissa = static_cast<std::uint32_t>(std::max(mantissa, 0));
  caps.etc1 = has(extensions, "GL_OES_compressed_ETC1_RGB8_texture");
  caps.depth24 = caps.gles_major >= 3 || has(extensions, "GL_OES_depth24");
  caps.timer = has(extensions, "GL_EXT_disjoint_timer_query");
  caps.software = std::strstr(renderer, "llvmpipe") != nullptr ||
                  std::strstr(renderer, "softpipe") != nullptr ||
                  std::strstr(renderer, "swrast") != nullptr;
  const bool gles3 = clamp_caps(caps, clamp).gles_major >= 3;
  load_extra(extensions, gles3, proc_address, out_extra);
  caps.discard = out_extra.discard_framebuffer != nullptr;
  if (out_extra.framebuffer_texture_multisample != nullptr)
    caps.max_samples = number(GL_MAX_SAMPLES_EXT);
  if (out_extra.renderbuffer_storage_multisample != nullptr &&
      out_extra.blit_framebuffer != nullptr)
    caps.max_samples = number(GL_MAX_SAMPLES);
  return clamp_caps(caps, clamp);
}

}  // namespace caryatid::platform::gles
