#pragma once
// The one place that includes GL. GLES 2.0 is linked; what is newer comes by name at run time and
// may be missing.
#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl3.h>

#include "platform/render/render.h"

namespace caryatid::platform::gles {

// Functions beyond GLES 2.0; null where the driver lacks them.
struct Extra {
  // GLES 3.0: multisampled renderbuffer, resolved by a blit.
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEEXTPROC renderbuffer_storage_multisample = nullptr;
  PFNGLBLITFRAMEBUFFERNVPROC blit_framebuffer = nullptr;
  // EXT_multisampled_render_to_texture: resolved by the tiler on its way out.
  PFNGLFRAMEBUFFERTEXTURE2DMULTISAMPLEEXTPROC framebuffer_texture_multisample = nullptr;
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEEXTPROC renderbuffer_storage_multisample_ext = nullptr;
  PFNGLDISCARDFRAMEBUFFEREXTPROC discard_framebuffer = nullptr;
  PFNGLGETGRAPHICSRESETSTATUSEXTPROC reset_status = nullptr;
};

// Asks the current context what it can do and loads what the answer allows, within `clamp`.
GpuCaps query_caps(BoardGpu clamp, GlProc (*proc_address)(const char*), Extra& out_extra);

constexpr Status fail(RenderFault fault, Code code = Code::unsupported) {
  return {code, static_cast<std::uint16_t>(fault)};
}

}  // namespace caryatid::platform::gles
