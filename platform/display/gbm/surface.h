#pragma once
// The buffers that GL draws and the screen scans out: a GBM surface under EGL.
#include <gbm.h>

#include <cstdint>

#include "platform/display/egl_context.h"
#include "platform/display/gbm/output.h"

namespace caryatid::platform::gbm {

inline constexpr std::uint32_t kFormat = GBM_FORMAT_XRGB8888;

class Surface {
 public:
  Surface() = default;
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  ~Surface() { destroy(); }

  // Makes the surface, in a layout of `modifiers` if it can, and the context current on it.
  // no_surface: neither layout will do.
  Status create(gbm_device* device, EglContext& egl, std::uint32_t width, std::uint32_t height,
                std::span<const std::uint64_t> modifiers, ErrorLine& out_error);
  // Leaves the context current on nothing. What is scanned out must be dark by then.
  void destroy();

  // Ends the picture and gives its framebuffer. The buffer that was given two calls before is
  // drawn on again. device_lost (context_lost): the GPU was reset. io (no_surface).
  Status swap(std::uint32_t& out_fb);
  // The framebuffer of the last swap is on the screen; the one before may be drawn on.
  void shown();

  bool has_modifiers() const { return with_modifiers_; }

 private:
  Status make(gbm_surface* surface, ErrorLine& out_error);

  EglContext* egl_ = nullptr;
  gbm_surface* gbm_ = nullptr;
  EGLSurface surface_ = EGL_NO_SURFACE;
  gbm_bo* on_screen_ = nullptr;
  gbm_bo* next_ = nullptr;
  bool with_modifiers_ = false;
};

}  // namespace caryatid::platform::gbm
