#pragma once
// How long the GPU worked on a picture, where no driver here has timer queries: a fence behind the
// last draw, and the time when it signals.
//
// gpu_us counts from the return of the swap (the last GL call; what the CPU did before is CPU time)
// to the signal. With EGL_ANDROID_native_fence_sync the kernel stamps the signal itself
// (SYNC_IOC_FILE_INFO), whenever it is asked; with EGL_KHR_fence_sync alone the time is that of the
// first look() that finds it, so somebody must look often while there is nothing else to do.
// Nothing here waits for the GPU, but wait(), which has a limit. No allocation of ours; the fence
// is the driver's.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdint>

#include "platform/display/display.h"

namespace caryatid::platform {

class GpuTimer {
 public:
  GpuTimer() = default;
  GpuTimer(const GpuTimer&) = delete;
  GpuTimer& operator=(const GpuTimer&) = delete;

  // Needs the context current. False: the driver has no fences; then all else does nothing.
  bool open(EGLDisplay display);
  // Before the display goes.
  void close();

  // Behind the last draw, before the swap that sends it off.
  void mark();
  // Right after the swap; without one this sends it off.
  void sent();
  // Whether nothing is outstanding any more. Never blocks.
  bool look();
  // Looks every kLook_us until nothing is outstanding or the time has come.
  void wait(std::int64_t end_us);
  // Someone must look() often, for the driver doesn't stamp.
  bool wants_looks() const { return fence_ != EGL_NO_SYNC_KHR && fd_ < 0; }
  // Of the picture sent last; Flip::kNotTimed while it is outstanding.
  std::uint32_t gpu_us() const { return gpu_us_; }

  static constexpr std::int64_t kLook_us = 250;

 private:
  void done(std::int64_t signalled_us);
  void drop();

  EGLDisplay display_ = EGL_NO_DISPLAY;
  PFNEGLCREATESYNCKHRPROC create_ = nullptr;
  PFNEGLDESTROYSYNCKHRPROC destroy_ = nullptr;
  PFNEGLCLIENTWAITSYNCKHRPROC client_wait_ = nullptr;
  PFNEGLDUPNATIVEFENCEFDANDROIDPROC dup_fd_ = nullptr;  // nullptr: the driver doesn't stamp.
  EGLSyncKHR fence_ = EGL_NO_SYNC_KHR;
  int fd_ = -1;
  std::int64_t sent_us_ = 0;
  std::uint32_t gpu_us_ = Flip::kNotTimed;
};

// When the fence behind a sync file signalled, monotonic; 0: not yet; -1: the kernel can't tell.
std::int64_t signalled_us(int sync_file);

}  // namespace caryatid::platform
