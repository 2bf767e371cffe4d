#pragma once
// Which of a screen's modes is set.
#include <xf86drmMode.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace caryatid::platform::gbm {

struct ModeWish {
  std::uint32_t width = 0, height = 0;  // Pixels of the panel as wired.
  bool insists = false;  // The deployer named this size; else the screen's own preference counts.
};

// Index into `modes`, which must not be empty. In this order: the size that was insisted on, the
// screen's preferred mode, the largest that is not larger than the wish, the first. Among modes of
// one size the one nearest to 60 Hz; interlaced modes only when there are no others.
std::size_t choose_mode(std::span<const drmModeModeInfo> modes, const ModeWish& wish);

// Time from one refresh to the next, microseconds; that of 60 Hz where the mode does not tell.
std::int64_t period_us(const drmModeModeInfo& mode);

}  // namespace caryatid::platform::gbm
