#include "platform/display/gbm/gbm.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <gbm.h>

#include "platform/clock/clock.h"
#include "platform/display/egl_context.h"
#include "platform/display/gbm/card.h"
#include "platform/display/gbm/console.h"
#include "platform/display/gbm/scanout.h"
#include "platform/display/gbm/surface.h"
#include "platform/display/gbm/watch.h"
#include "platform/log/log.h"

namespace caryatid::platform {
namespace gbm {
namespace {

constexpr Status fail(Code code, DisplayFault fault) {
  return {code, static_cast<std::uint16_t>(fault)};
}

class Device {
 public:
  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device() {
    if (device_ != nullptr) gbm_device_destroy(device_);
  }
  bool open(int card) { return (device_ = gbm_create_device(card)) != nullptr; }
  gbm_device* get() const { return device_; }

 private:
  gbm_device* device_ = nullptr;
};

class GbmDisplay final : public Display {
 public:
  ~GbmDisplay() override { scanout_.restore(); }

  Status open(const DisplayOptions& options, ErrorLine& out_error);
  const char* name() const override { return "drm"; }
  std::uint32_t width() const override { return width_; }
  std::uint32_t height() const override { return height_; }
  bool has_surface() const override { return true; }
  GlProc proc_address(const char* gl_name) const override { return eglGetProcAddress(gl_name); }
  Status poll(std::int64_t now_us, DisplayEvents& out) override;
  Status present() override;
  Flip last_flip() const override;
  std::int64_t refresh_us() const override {
    return output_.connector != 0 ? period_us(output_.mode) : 0;
  }
  bool visible() const override { return watch_.in_use() && powered_; }
  void set_power(bool on) override;

 private:
  Status look_for_screen(ErrorLine& out_error);
  Status use(const Output& output, ErrorLine& out_error);
  Status take_in(Status shown);
  void tell(Event event, const char* what);

  // In this order they are made, and in the other one destroyed.
  Console console_;
  Card card_;
  Device device_;
  EglContext egl_;
  Surface surface_;
  Scanout scanout_;

  ScreenWatch watch_;
  Output output_;
  ModeWish wish_;
  std::uint32_t width_ = 0, height_ = 0;
  bool powered_ = true;
  bool plain_ = false;  // This screen refused a buffer of a vendor's layout.
};

Status GbmDisplay::open(const DisplayOptions& options, ErrorLine& out_error) {
  wish_ = {options.width, options.height, options.insists_on_size};
  CARYATID_TRY(card_.open(out_error, options.legacy_kms));
  const bool may_wait = options.kind == DisplayKind::drm;
  if (!card_.take_master() && !may_wait) {
    set_error(out_error, "another program owns the screen");
    return fail(Code::io, DisplayFault::not_master);
  }
  if (!device_.open(card_.fd())) {
    set_error(out_error, "no buffers on the graphics card (GBM); install Mesa's DRI drivers");
    return fail(Code::unsupported, DisplayFault::no_egl);
  }
  // The surface itself has one sample: the renderer multisamples in framebuffers of its own.
  CARYATID_TRY(egl_.open({.platform = EGL_PLATFORM_GBM_KHR,
                          .native_display = device_.get(),
                          .surface_bit = EGL_WINDOW_BIT,
                          .visual_id = static_cast<EGLint>(kFormat)},
                         out_error));
  if (options.times_gpu) egl_.time_gpu();
  const Status found = look_for_screen(out_error);
  if (found.ok() || !may_wait || found.code != Code::not_ready) {
    if (found.ok()) console_.take();
    return found;
  }
  // Something to draw on until a screen comes.
  width_ = options.width;
  height_ = options.height;
  console_.take();
  return surface_.create(device_.get(), egl_, width_, height_, {}, out_error);
}

void GbmDisplay::tell(Event event, const char* what) {
  log(event, "screen %s %ux%u: %s", output_.name.size() > 0 ? output_.name.c_str() : "(none)",
      width_, height_, what);
}

// not_ready: none is connected, or it cannot be used now.
Status GbmDisplay::look_for_screen(ErrorLine& out_error) {
  Output output;
  Status status = find_output(card_.fd(), card_.atomic(), wish_, output);
  if (status.code == Code::io) status.code = Code::device_lost;
  if (status.ok() && !card_.take_master()) status = fail(Code::not_ready, DisplayFault::not_master);
  if (status.ok()) return use(output, out_error);
  set_error(out_error, "no screen is connected");
  if (watch_.missing())
    tell(Event::screen_lost, status.detail == static_cast<std::uint16_t>(DisplayFault::not_master)
                                 ? "another program owns it; waiting until it is free"
                                 : "not connected; waiting for it");
  return status;
}

Status GbmDisplay::use(const Output& output, ErrorLine& out_error) {
  const bool same_size = width_ == output.mode.hdisplay && height_ == output.mode.vdisplay;
  output_ = output;
  width_ = output.mode.hdisplay;
  height_ = output.mode.vdisplay;
  if (!same_size || (plain_ && surface_.has_modifiers())) {
    const bool modifiers = card_.modifiers() && !plain_;
    CARYATID_TRY(surface_.create(
        device_.get(), egl_, width_, height_,
        modifiers ? output_.modifiers.span() : std::span<const std::uint64_t>{}, out_error));
  }
  scanout_.attach(card_.fd(), card_.atomic(), output_);
  if (watch_.found())
    tell(Event::screen_found, card_.atomic() ? "in use (atomic)" : "in use (legacy calls)");
  return {};
}

Status GbmDisplay::poll(std::int64_t, DisplayEvents& out) {
  ErrorLine ignored;
  switch (watch_.due(monotonic_us())) {
    case ScreenWatch::Action::nothing:
      return {};
    case ScreenWatch::Action::look:
      if (still_connected(card_.fd(), output_.connector)) return {};
      // The kernel keeps the pipe running until told otherwise.
      scanout_.darken();
      watch_.doubt();
      break;
    case ScreenWatch::Action::probe:
      break;
  }
  const std::uint32_t width_before = width_, height_before = height_;
  const Status status = look_for_screen(ignored);
  out.resized = out.resized || width_ != width_before || height_ != height_before;
  return status.code == Code::not_ready ? Status{} : status;
}

Status GbmDisplay::present() {
  if (!visible()) return {};
  std::uint32_t fb = 0;
  const Status swapped = surface_.swap(fb);
  if (!swapped.ok() && swapped.code != Code::io) return swapped;
  Status shown = swapped;
  GpuTimer& timer = egl_.timer();
  if (swapped.ok())
    shown =
        scanout_.show(fb, timer.wants_looks()
                              ? Meanwhile{[](void* t) { return static_cast<GpuTimer*>(t)->look(); },
                                          &timer, GpuTimer::kLook_us}
                              : Meanwhile{});
  (void)timer.look();
  return take_in(shown);
}

Flip GbmDisplay::last_flip() const {
  Flip flip = scanout_.last_flip();
  flip.gpu_us = egl_.timer().gpu_us();
  return flip;
}

// What cannot be shown now is no reason to end; the next probe, in a second at most, tries again.
Status GbmDisplay::take_in(Status shown) {
  if (shown.ok()) {
    surface_.shown();
    return {};
  }
  if (shown.code == Code::device_lost) return shown;
  plain_ = plain_ || surface_.has_modifiers();
  watch_.doubt();
  return {};
}

void GbmDisplay::set_power(bool on) {
  if (powered_ == on) return;
  powered_ = on;
  if (!on) scanout_.darken();
}

}  // namespace
}  // namespace gbm

Status open_gbm(const DisplayOptions& options, std::unique_ptr<Display>& out,
                ErrorLine& out_error) {
  constexpr std::int64_t kPatience_us = 10'000'000, kPause_us = 250'000;
  const std::int64_t began_us = monotonic_us();
  for (;;) {
    auto display = std::make_unique<gbm::GbmDisplay>();
    const Status status = display->open(options, out_error);
    if (status.ok()) {
      out = std::move(display);
      return status;
    }
    const bool may_come = status.detail == static_cast<std::uint16_t>(DisplayFault::no_card);
    const std::int64_t now_us = monotonic_us();
    if (options.kind != DisplayKind::drm || !may_come || now_us > began_us + kPatience_us)
      return status;
    sleep_until_us(now_us + kPause_us);
  }
}

}  // namespace caryatid::platform
