#pragma once
// What all EGL displays share: a display connection, a configuration, a context.
#include <EGL/egl.h>

#include "platform/display/display.h"
#include "platform/display/gpu_timer.h"

namespace caryatid::platform {

// EGL enumerants for a platform display; native is what that platform wants.
struct EglRequest {
  EGLenum platform = 0;
  void* native_display = nullptr;
  EGLint surface_bit = 0;  // 0: no surface at all.
  EGLint samples = 0;      // Tried first; 0 is the fallback.
  EGLint visual_id = 0;    // Take the configuration with this EGL_NATIVE_VISUAL_ID; 0: the first.
};

// Owns display and context. Tries GLES 3, then 2; asks for robustness where it is offered.
class EglContext {
 public:
  EglContext() = default;
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext();

  // Fills everything but the surface. On failure says why in `out_error`.
  Status open(const EglRequest& request, ErrorLine& out_error);
  // Makes the context current on `surface` (EGL_NO_SURFACE: without one).
  Status make_current(EGLSurface surface, ErrorLine& out_error);
  // Swaps; device_lost (context_lost) when the GPU was reset. Without a surface sends off what was
  // drawn.
  Status swap(EGLSurface surface);
  // For displays without a flip to wait for: waits for the GPU instead, at most kGpuWait_us, and
  // fills in waited_us and gpu_us.
  void wait_for_gpu(Flip& io_flip);
  // From the first swap on, where the driver has fences.
  void time_gpu() { times_gpu_ = true; }
  GpuTimer& timer() { return timer_; }
  const GpuTimer& timer() const { return timer_; }

  static constexpr std::int64_t kGpuWait_us = 100'000;

  EGLDisplay display() const { return display_; }
  EGLConfig config() const { return config_; }
  EGLint native_visual_id() const;

 private:
  Status choose_config(const EglRequest& request, ErrorLine& out_error);
  Status create_context(ErrorLine& out_error);

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLConfig config_ = nullptr;
  EGLContext context_ = EGL_NO_CONTEXT;
  bool times_gpu_ = false;
  GpuTimer timer_;
};

// Whether `name` is a word of the space-separated list `extensions` (nullptr: no).
bool has_extension(const char* extensions, const char* name);

void set_error(ErrorLine& out, const char* text);
// "text (EGL error 0x3008)".
void set_egl_error(ErrorLine& out, const char* text);

}  // namespace caryatid::platform
