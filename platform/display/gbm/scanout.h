#pragma once
// Shows framebuffers on an output: one mode set, then a page flip for each picture. Atomic commits
// where the driver has them, else the older SetCrtc and PageFlip calls.
//
// States: dark -> (first show) lit -> (show) flipping -> (event) lit. A flip whose event does not
// come within three periods is asked for again; after three such losses the driver is stuck.
// No allocation of ours; libdrm allocates a request for each atomic commit.
#include <xf86drm.h>

#include <cstdint>

#include "platform/display/display.h"
#include "platform/display/gbm/output.h"

namespace caryatid::platform::gbm {

// What to do again and again while a flip is waited for, until it returns true.
struct Meanwhile {
  bool (*look)(void* self) = nullptr;
  void* self = nullptr;
  std::int64_t every_us = 0;
};

class Scanout {
 public:
  Scanout() = default;
  Scanout(const Scanout&) = delete;
  Scanout& operator=(const Scanout&) = delete;
  ~Scanout() {
    forget();
    drmModeFreeCrtc(before_);
  }

  // Takes an output of `card`; its mode is set with the next picture. Remembers what the CRTC
  // showed before the first call.
  void attach(int card, bool atomic, const Output& output);
  // Shows `fb` and waits until the screen has it.
  // not_ready (not_master): another program owns the screen. not_ready (no_screen): the mode or
  // the layout is refused, most likely since the cable was pulled. device_lost (flip_lost): the
  // driver loses flips. device_lost (no_card): the card is gone.
  Status show(std::uint32_t fb, Meanwhile meanwhile = {});
  // Stops scanning out; the next show() sets the mode again. Errors are of no use to anyone.
  void darken();
  // Puts back what the screen showed before us. After it nothing may be shown.
  void restore();

  const Flip& last_flip() const { return flip_; }
  std::uint32_t lost_flips() const { return lost_; }

 private:
  enum class State : std::uint8_t { dark, lit, flipping };

  static void on_flip(int, unsigned sequence, unsigned s, unsigned us, unsigned, void* self);
  Status submit(std::uint32_t fb);
  int set_mode(std::uint32_t fb);
  int flip(std::uint32_t fb);
  int commit(std::uint32_t fb, bool with_mode);
  bool wait(std::int64_t end_us, Meanwhile meanwhile = {});
  Status refused(int error);
  void forget();

  int card_ = -1;
  bool atomic_ = false;
  Output output_;
  std::int64_t period_us_ = 16667;
  std::uint32_t mode_blob_ = 0;
  State state_ = State::dark;
  drmModeCrtc* before_ = nullptr;  // What the CRTC showed when we came.
  std::uint32_t before_connector_ = 0;
  Flip flip_;
  std::uint32_t sequence_ = 0;
  std::uint32_t lost_ = 0;
};

}  // namespace caryatid::platform::gbm
