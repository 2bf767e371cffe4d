#include "platform/display/egl_context.h"

#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "platform/clock/clock.h"

namespace caryatid::platform {
namespace {

constexpr Status fail(DisplayFault fault, Code code = Code::unsupported) {
  return {code, static_cast<std::uint16_t>(fault)};
}

// eglGetPlatformDisplay came with EGL 1.5; older libraries have it as an extension.
EGLDisplay get_platform_display(EGLenum platform, void* native) {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!has_extension(client, "EGL_EXT_platform_base")) return EGL_NO_DISPLAY;
  const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get != nullptr ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
}

}  // namespace

bool has_extension(const char* extensions, const char* name) {
  if (extensions == nullptr) return false;
  const std::size_t length = std::strlen(name);
  for (const char* at = std::strstr(extensions, name); at != nullptr;
       at = std::strstr(at + length, name)) {
    const bool starts = at == extensions || at[-1] == ' ';
    if (starts && (at[length] == ' ' || at[length] == '\0')) return true;
  }
  return false;
}

void set_error(ErrorLine& out, const char* text) { out.assign({text, std::strlen(text)}); }

void set_egl_error(ErrorLine& out, const char* text) {
  std::array<char, 256> line{};
  const int n = std::snprintf(line.data(), line.size(), "%s (EGL error 0x%04x)", text,
                              static_cast<unsigned>(eglGetError()));
  out.assign({line.data(), std::min(static_cast<std::size_t>(n), line.size() - 1)});
}

EglContext::~EglContext() {
  if (display_ == EGL_NO_DISPLAY) return;
  timer_.close();
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

Status EglContext::open(const EglRequest& request, ErrorLine& out_error) {
  display_ = get_platform_display(request.platform, request.native_display);
  if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) {
    display_ = EGL_NO_DISPLAY;
    set_egl_error(out_error, "EGL does not start; install Mesa's EGL and DRI drivers");
    return fail(DisplayFault::no_egl);
  }
  eglBindAPI(EGL_OPENGL_ES_API);
  CARYATID_TRY(choose_config(request, out_error));
  return create_context(out_error);
}

// The order of eglChooseConfig prefers deep colours and must not decide: where the platform has
// visuals, only the matching one works.
Status EglContext::choose_config(const EglRequest& request, ErrorLine& out_error) {
  for (const EGLint samples : {request.samples, 0}) {
    for (const EGLint depth : {24, 16}) {
      // clang-format off
      const EGLint wanted[] = {EGL_SURFACE_TYPE, request.surface_bit,
                               EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT,
                               EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8,
                               EGL_DEPTH_SIZE, request.surface_bit != 0 ? depth : 0,
                               EGL_SAMPLES, samples, EGL_NONE};
      // clang-format on
      std::array<EGLConfig, 64> found{};
      EGLint count = 0;
      if (eglChooseConfig(display_, wanted, found.data(), 64, &count) != EGL_TRUE) continue;
      for (int i = 0; i < count; ++i) {
        config_ = found[static_cast<std::size_t>(i)];
        if (request.visual_id == 0 || native_visual_id() == request.visual_id) return {};
      }
    }
  }
  set_egl_error(out_error, "no framebuffer format with 8-bit colour suits this display");
  return fail(DisplayFault::no_config);
}

EGLint EglContext::native_visual_id() const {
  EGLint id = 0;
  eglGetConfigAttrib(display_, config_, EGL_NATIVE_VISUAL_ID, &id);
  return id;
}

Status EglContext::create_context(ErrorLine& out_error) {
  const char* extensions = eglQueryString(display_, EGL_EXTENSIONS);
  const bool robust = has_extension(extensions, "EGL_EXT_create_context_robustness");
  for (const bool ask_robust : {true, false}) {
    if (ask_robust && !robust) continue;
    for (const EGLint version : {3, 2}) {
      const EGLint reset = EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT;
      const EGLint attributes[] = {EGL_CONTEXT_CLIENT_VERSION, version,
                                   ask_robust ? reset : EGL_NONE, EGL_LOSE_CONTEXT_ON_RESET_EXT,
                                   EGL_NONE};
      context_ = eglCreateContext(display_, config_, EGL_NO_CONTEXT, attributes);
      if (context_ != EGL_NO_CONTEXT) return {};
    }
  }
  set_egl_error(out_error, "the graphics driver offers no OpenGL ES 2.0");
  return fail(DisplayFault::no_context);
}

Status EglContext::make_current(EGLSurface surface, ErrorLine& out_error) {
  if (eglMakeCurrent(display_, surface, surface, context_) == EGL_TRUE) {
    if (times_gpu_) times_gpu_ = timer_.open(display_);
    return {};
  }
  set_egl_error(out_error, "the OpenGL ES context cannot be used on this display");
  return fail(DisplayFault::no_context);
}

void EglContext::wait_for_gpu(Flip& io_flip) {
  const std::int64_t began_us = monotonic_us();
  timer_.wait(began_us + kGpuWait_us);
  io_flip.waited_us += static_cast<std::uint32_t>(monotonic_us() - began_us);
  io_flip.gpu_us = timer_.gpu_us();
}

Status EglContext::swap(EGLSurface surface) {
  timer_.mark();
  const bool swapped = surface == EGL_NO_SURFACE || eglSwapBuffers(display_, surface) == EGL_TRUE;
  timer_.sent();
  if (swapped) return {};
  const EGLint error = eglGetError();
  if (error == EGL_CONTEXT_LOST || error == EGL_BAD_NATIVE_WINDOW || error == EGL_BAD_SURFACE)
    return fail(DisplayFault::context_lost, Code::device_lost);
  return fail(DisplayFault::no_surface, Code::io);
}

}  // namespace caryatid::platform
