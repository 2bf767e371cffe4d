#include "platform/display/surfaceless/surfaceless.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "platform/display/egl_context.h"

namespace caryatid::platform {
namespace {

class SurfacelessDisplay final : public Display {
 public:
  Status open(const DisplayOptions& options, ErrorLine& out_error) {
    width_ = options.width;
    height_ = options.height;
    CARYATID_TRY(egl_.open(
        {.platform = EGL_PLATFORM_SURFACELESS_MESA, .native_display = EGL_DEFAULT_DISPLAY},
        out_error));
    times_gpu_ = options.times_gpu;
    if (times_gpu_) egl_.time_gpu();
    return egl_.make_current(EGL_NO_SURFACE, out_error);
  }

  const char* name() const override { return "surfaceless"; }
  std::uint32_t width() const override { return width_; }
  std::uint32_t height() const override { return height_; }
  bool has_surface() const override { return false; }
  GlProc proc_address(const char* gl_name) const override { return eglGetProcAddress(gl_name); }
  Status poll(std::int64_t, DisplayEvents&) override { return {}; }
  Status present() override {
    if (!times_gpu_) return {};
    CARYATID_TRY(egl_.swap(EGL_NO_SURFACE));
    flip_ = {};
    egl_.wait_for_gpu(flip_);
    return {};
  }
  Flip last_flip() const override { return flip_; }

 private:
  EglContext egl_;
  Flip flip_;
  bool times_gpu_ = false;
  std::uint32_t width_ = 0, height_ = 0;
};

}  // namespace

Status open_surfaceless(const DisplayOptions& options, std::unique_ptr<Display>& out,
                        ErrorLine& out_error) {
  auto display = std::make_unique<SurfacelessDisplay>();
  CARYATID_TRY(display->open(options, out_error));
  out = std::move(display);
  return {};
}

}  // namespace caryatid::platform
