#include "platform/display/gpu_timer.h"

#include <linux/sync_file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "platform/clock/clock.h"
#include "platform/display/egl_context.h"

namespace caryatid::platform {

std::int64_t signalled_us(int sync_file) {
  std::array<sync_fence_info, 8> fences{};  // One by queue of the GPU; more than enough.
  sync_file_info info{};
  info.num_fences = fences.size();
  info.sync_fence_info = reinterpret_cast<std::uintptr_t>(fences.data());
  if (ioctl(sync_file, SYNC_IOC_FILE_INFO, &info) != 0 || info.status < 0) return -1;
  if (info.status == 0) return 0;
  std::uint64_t last_ns = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(info.num_fences, fences.size()); ++i)
    last_ns = std::max<std::uint64_t>(last_ns, fences[i].timestamp_ns);
  return static_cast<std::int64_t>(last_ns / 1000);
}

bool GpuTimer::open(EGLDisplay display) {
  const char* has = eglQueryString(display, EGL_EXTENSIONS);
  if (!has_extension(has, "EGL_KHR_fence_sync")) return false;
  create_ = reinterpret_cast<PFNEGLCREATESYNCKHRPROC>(eglGetProcAddress("eglCreateSyncKHR"));
  destroy_ = reinterpret_cast<PFNEGLDESTROYSYNCKHRPROC>(eglGetProcAddress("eglDestroySyncKHR"));
  client_wait_ =
      reinterpret_cast<PFNEGLCLIENTWAITSYNCKHRPROC>(eglGetProcAddress("eglClientWaitSyncKHR"));
  if (create_ == nullptr || destroy_ == nullptr || client_wait_ == nullptr) return false;
  if (has_extension(has, "EGL_ANDROID_native_fence_sync"))
    dup_fd_ = reinterpret_cast<PFNEGLDUPNATIVEFENCEFDANDROIDPROC>(
        eglGetProcAddress("eglDupNativeFenceFDANDROID"));
  display_ = display;
  return true;
}

void GpuTimer::close() {
  drop();
  display_ = EGL_NO_DISPLAY;
}

void GpuTimer::drop() {
  if (fence_ != EGL_NO_SYNC_KHR) destroy_(display_, fence_);
  if (fd_ >= 0) ::close(fd_);
  fence_ = EGL_NO_SYNC_KHR;
  fd_ = -1;
}

void GpuTimer::mark() {
  drop();
  gpu_us_ = Flip::kNotTimed;
  if (display_ == EGL_NO_DISPLAY) return;
  if (dup_fd_ != nullptr) fence_ = create_(display_, EGL_SYNC_NATIVE_FENCE_ANDROID, nullptr);
  // Promised, but the kernel lacks it.
  if (fence_ == EGL_NO_SYNC_KHR) fence_ = create_(display_, EGL_SYNC_FENCE_KHR, nullptr);
}

void GpuTimer::sent() {
  sent_us_ = monotonic_us();
  if (fence_ == EGL_NO_SYNC_KHR || dup_fd_ == nullptr) return;
  fd_ = dup_fd_(display_, fence_);  // There only once the swap has flushed it.
}

bool GpuTimer::look() {
  if (fence_ == EGL_NO_SYNC_KHR) return true;
  if (fd_ >= 0) {
    const std::int64_t at_us = signalled_us(fd_);
    if (at_us == 0) return false;
    if (at_us > 0)
      done(at_us);
    else
      drop();
    return true;
  }
  const EGLint state = client_wait_(display_, fence_, EGL_SYNC_FLUSH_COMMANDS_BIT_KHR, 0);
  if (state == EGL_TIMEOUT_EXPIRED_KHR) return false;
  if (state == EGL_CONDITION_SATISFIED_KHR)
    done(monotonic_us());
  else
    drop();
  return true;
}

void GpuTimer::wait(std::int64_t end_us) {
  while (!look()) {
    const std::int64_t now_us = monotonic_us();
    if (now_us >= end_us) return;
    sleep_until_us(std::min(now_us + kLook_us, end_us));
  }
}

// The GPU may be done before the swap returns.
void GpuTimer::done(std::int64_t signalled_us) {
  gpu_us_ = static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(signalled_us - sent_us_, 0, std::int64_t{Flip::kNotTimed} - 1));
  drop();
}

}  // namespace caryatid::platform
