#include "platform/display/gbm/surface.h"

#include <xf86drmMode.h>

namespace caryatid::platform::gbm {
namespace {

void remove_framebuffer(gbm_bo* bo, void* id) {
  drmModeRmFB(gbm_device_get_fd(gbm_bo_get_device(bo)),
              static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(id)));
}

// The framebuffer of a buffer; made once, and removed with the buffer by GBM. 0: refused.
std::uint32_t framebuffer_of(gbm_bo* bo, bool with_modifiers) {
  if (void* const known = gbm_bo_get_user_data(bo))
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(known));
  std::uint32_t handles[4] = {}, strides[4] = {}, offsets[4] = {};
  std::uint64_t modifiers[4] = {};
  const int planes = gbm_bo_get_plane_count(bo);
  for (int p = 0; p < planes && p < 4; ++p) {
    handles[p] = gbm_bo_get_handle_for_plane(bo, p).u32;
    strides[p] = gbm_bo_get_stride_for_plane(bo, p);
    offsets[p] = gbm_bo_get_offset(bo, p);
    modifiers[p] = gbm_bo_get_modifier(bo);
  }
  const int card = gbm_device_get_fd(gbm_bo_get_device(bo));
  std::uint32_t id = 0;
  const int refused =
      with_modifiers ? drmModeAddFB2WithModifiers(card, gbm_bo_get_width(bo), gbm_bo_get_height(bo),
                                                  kFormat, handles, strides, offsets, modifiers,
                                                  &id, DRM_MODE_FB_MODIFIERS)
                     : drmModeAddFB2(card, gbm_bo_get_width(bo), gbm_bo_get_height(bo), kFormat,
                                     handles, strides, offsets, &id, 0);
  if (refused != 0) return 0;
  gbm_bo_set_user_data(bo, reinterpret_cast<void*>(std::uintptr_t{id}), remove_framebuffer);
  return id;
}

}  // namespace

Status Surface::create(gbm_device* device, EglContext& egl, std::uint32_t width,
                       std::uint32_t height, std::span<const std::uint64_t> modifiers,
                       ErrorLine& out_error) {
  destroy();
  egl_ = &egl;
  with_modifiers_ = !modifiers.empty();
  if (with_modifiers_ &&
      make(gbm_surface_create_with_modifiers(device, width, height, kFormat, modifiers.data(),
                                             static_cast<unsigned>(modifiers.size())),
           out_error)
          .ok())
    return {};
  with_modifiers_ = false;
  return make(
      gbm_surface_create(device, width, height, kFormat, GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING),
      out_error);
}

Status Surface::make(gbm_surface* surface, ErrorLine& out_error) {
  gbm_ = surface;
  if (gbm_ != nullptr)
    surface_ = eglCreateWindowSurface(egl_->display(), egl_->config(),
                                      reinterpret_cast<EGLNativeWindowType>(gbm_), nullptr);
  if (surface_ == EGL_NO_SURFACE) {
    set_egl_error(out_error, "no buffers that GL can draw and the screen can show");
    destroy();
    return {Code::unsupported, static_cast<std::uint16_t>(DisplayFault::no_surface)};
  }
  return egl_->make_current(surface_, out_error);
}

void Surface::destroy() {
  if (gbm_ != nullptr && next_ != nullptr) gbm_surface_release_buffer(gbm_, next_);
  if (gbm_ != nullptr && on_screen_ != nullptr) gbm_surface_release_buffer(gbm_, on_screen_);
  next_ = on_screen_ = nullptr;
  if (surface_ != EGL_NO_SURFACE) {
    eglMakeCurrent(egl_->display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(egl_->display(), surface_);
  }
  surface_ = EGL_NO_SURFACE;
  if (gbm_ != nullptr) gbm_surface_destroy(gbm_);
  gbm_ = nullptr;
}

Status Surface::swap(std::uint32_t& out_fb) {
  out_fb = 0;
  if (next_ != nullptr) gbm_surface_release_buffer(gbm_, next_);  // It never came on the screen.
  next_ = nullptr;
  CARYATID_TRY(egl_->swap(surface_));
  next_ = gbm_surface_lock_front_buffer(gbm_);
  if (next_ != nullptr) out_fb = framebuffer_of(next_, with_modifiers_);
  if (out_fb != 0) return {};
  return {Code::io, static_cast<std::uint16_t>(DisplayFault::no_surface)};
}

void Surface::shown() {
  if (on_screen_ != nullptr) gbm_surface_release_buffer(gbm_, on_screen_);
  on_screen_ = next_;
  next_ = nullptr;
}

}  // namespace caryatid::platform::gbm
