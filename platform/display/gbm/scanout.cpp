#include "platform/display/gbm/scanout.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>

#include "platform/clock/clock.h"

namespace caryatid::platform::gbm {
namespace {

constexpr int kPeriodsToWait = 3, kLossesToBear = 3;
// A flip may wait for a whole frame of a slow GPU before its period begins.
constexpr std::int64_t kLeastWait_us = 200'000;

constexpr Status fail(Code code, DisplayFault fault) {
  return {code, static_cast<std::uint16_t>(fault)};
}

}  // namespace

void Scanout::attach(int card, bool atomic, const Output& output) {
  forget();
  if (before_ == nullptr) {
    before_ = drmModeGetCrtc(card, output.crtc);
    before_connector_ = output.connector;
  }
  card_ = card;
  atomic_ = atomic;
  output_ = output;
  period_us_ = period_us(output.mode);
  state_ = State::dark;
  sequence_ = 0;
}

void Scanout::forget() {
  if (mode_blob_ != 0) drmModeDestroyPropertyBlob(card_, mode_blob_);
  mode_blob_ = 0;
}

void Scanout::on_flip(int, unsigned sequence, unsigned s, unsigned us, unsigned, void* user) {
  auto& self = *static_cast<Scanout*>(user);
  if (self.state_ != State::flipping) return;  // A late one of a flip that was given up.
  const std::int64_t time_us = std::int64_t{s} * 1'000'000 + us;
  // Some drivers have no counter; then the time tells.
  const std::int64_t passed_us = time_us - self.flip_.time_us;
  std::int64_t periods = (passed_us + self.period_us_ / 2) / self.period_us_;
  if (sequence > self.sequence_ && self.sequence_ != 0) periods = sequence - self.sequence_;
  const bool known = self.flip_.count > 0 && periods >= 0 && periods < 0xffff;
  self.flip_.vblanks = static_cast<std::uint16_t>(known ? periods : 0);
  self.sequence_ = sequence;
  self.flip_.time_us = time_us;
  ++self.flip_.count;
  self.state_ = State::lit;
}

Status Scanout::show(std::uint32_t fb, Meanwhile meanwhile) {
  const std::int64_t began_us = monotonic_us();
  for (int loss = 0; loss < kLossesToBear; ++loss) {
    CARYATID_TRY(submit(fb));
    const std::int64_t patience_us = std::max(kPeriodsToWait * period_us_, kLeastWait_us);
    if (wait(monotonic_us() + patience_us, meanwhile)) {
      flip_.waited_us = static_cast<std::uint32_t>(monotonic_us() - began_us);
      return {};
    }
    ++lost_;
  }
  return fail(Code::device_lost, DisplayFault::flip_lost);
}

Status Scanout::submit(std::uint32_t fb) {
  if (state_ == State::dark) {
    if (const int error = set_mode(fb); error != 0) return refused(error);
    // A mode set is done when it returns, and no event follows it.
    state_ = State::lit;
  }
  const int error = flip(fb);
  // Busy: the flip that we gave up is still on its way and will do.
  if (error != 0 && error != EBUSY) return refused(error);
  state_ = State::flipping;
  return {};
}

int Scanout::set_mode(std::uint32_t fb) {
  if (!atomic_) {
    const int result =
        drmModeSetCrtc(card_, output_.crtc, fb, 0, 0, &output_.connector, 1, &output_.mode);
    return result == 0 ? 0 : errno;
  }
  if (mode_blob_ == 0 &&
      drmModeCreatePropertyBlob(card_, &output_.mode, sizeof output_.mode, &mode_blob_) != 0)
    return errno;
  return commit(fb, true);
}

int Scanout::flip(std::uint32_t fb) {
  if (atomic_) return commit(fb, false);
  const int result = drmModePageFlip(card_, output_.crtc, fb, DRM_MODE_PAGE_FLIP_EVENT, this);
  return result == 0 ? 0 : errno;
}

int Scanout::commit(std::uint32_t fb, bool with_mode) {
  drmModeAtomicReq* const request = drmModeAtomicAlloc();
  if (request == nullptr) return ENOMEM;
  const auto set = [request](std::uint32_t object, std::uint32_t property, std::uint64_t value) {
    drmModeAtomicAddProperty(request, object, property, value);
  };
  const PropertyIds& ids = output_.ids;
  if (with_mode) {
    set(output_.connector, ids.connector_crtc, fb != 0 ? output_.crtc : 0);
    set(output_.crtc, ids.crtc_mode, fb != 0 ? mode_blob_ : 0);
    set(output_.crtc, ids.crtc_active, fb != 0);
    const std::uint64_t size[4] = {0, 0, fb != 0 ? output_.mode.hdisplay : 0u,
                                   fb != 0 ? output_.mode.vdisplay : 0u};
    for (std::size_t i = 0; i < 4; ++i) {
      set(output_.plane, ids.plane_source[i], size[i] << 16);  // 16.16 fixed point.
      set(output_.plane, ids.plane_target[i], size[i]);
    }
  }
  set(output_.plane, ids.plane_fb, fb);
  set(output_.plane, ids.plane_crtc, fb != 0 ? output_.crtc : 0);
  const std::uint32_t flags = with_mode ? DRM_MODE_ATOMIC_ALLOW_MODESET
                                        : DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT;
  const int error = drmModeAtomicCommit(card_, request, flags, this) == 0 ? 0 : errno;
  drmModeAtomicFree(request);
  return error;
}

bool Scanout::wait(std::int64_t end_us, Meanwhile meanwhile) {
  drmEventContext context{};
  context.version = 3;
  context.page_flip_handler2 = on_flip;
  while (state_ == State::flipping) {
    const std::int64_t left_us = end_us - monotonic_us();
    if (left_us <= 0) return false;
    if (meanwhile.look != nullptr && meanwhile.look(meanwhile.self)) meanwhile.look = nullptr;
    const std::int64_t pause_us =
        meanwhile.look != nullptr ? std::min(left_us, meanwhile.every_us) : left_us + 1000;
    const timespec pause{static_cast<time_t>(pause_us / 1'000'000),
                         static_cast<long>(pause_us % 1'000'000 * 1000)};
    pollfd ready{card_, POLLIN, 0};
    const int count = ::ppoll(&ready, 1, &pause, nullptr);
    if (count > 0 && drmHandleEvent(card_, &context) != 0) return false;
  }
  return true;
}

Status Scanout::refused(int error) {
  state_ = State::dark;
  if (error == ENODEV) return fail(Code::device_lost, DisplayFault::no_card);
  if (error == EACCES || error == EPERM) return fail(Code::not_ready, DisplayFault::not_master);
  return fail(Code::not_ready, DisplayFault::no_screen);
}

void Scanout::darken() {
  if (card_ < 0) return;
  // A flip that is on its way would make the driver refuse.
  if (state_ == State::flipping) (void)wait(monotonic_us() + kPeriodsToWait * period_us_);
  if (atomic_)
    (void)commit(0, true);
  else
    (void)drmModeSetCrtc(card_, output_.crtc, 0, 0, 0, nullptr, 0, nullptr);
  state_ = State::dark;
}

void Scanout::restore() {
  if (card_ < 0) return;
  darken();
  if (before_ != nullptr) {
    if (before_->buffer_id != 0 && before_->mode_valid != 0)
      (void)drmModeSetCrtc(card_, before_->crtc_id, before_->buffer_id, before_->x, before_->y,
                           &before_connector_, 1, &before_->mode);
    drmModeFreeCrtc(before_);
  }
  before_ = nullptr;
  forget();
  card_ = -1;
}

}  // namespace caryatid::platform::gbm
