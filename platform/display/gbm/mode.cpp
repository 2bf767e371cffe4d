#include "platform/display/gbm/mode.h"

#include <cstdlib>

namespace caryatid::platform::gbm {
namespace {

constexpr std::int64_t k60Hz_us = 16667;

bool interlaced(const drmModeModeInfo& m) { return (m.flags & DRM_MODE_FLAG_INTERLACE) != 0; }

// Whether a shows better than b, both of a fitting size.
bool better(const drmModeModeInfo& a, const drmModeModeInfo& b) {
  if (interlaced(a) != interlaced(b)) return interlaced(b);
  const int pixels_a = a.hdisplay * a.vdisplay, pixels_b = b.hdisplay * b.vdisplay;
  if (pixels_a != pixels_b) return pixels_a > pixels_b;
  return std::abs(period_us(a) - k60Hz_us) < std::abs(period_us(b) - k60Hz_us);
}

// The best of those that `fits`, or modes.size().
template <class Fits>
std::size_t best(std::span<const drmModeModeInfo> modes, Fits fits) {
  std::size_t found = modes.size();
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (fits(modes[i]) && (found == modes.size() || better(modes[i], modes[found]))) found = i;
  return found;
}

}  // namespace

std::size_t choose_mode(std::span<const drmModeModeInfo> modes, const ModeWish& wish) {
  std::size_t found = modes.size();
  if (wish.insists)
    found = best(modes, [&](const drmModeModeInfo& m) {
      return m.hdisplay == wish.width && m.vdisplay == wish.height;
    });
  if (found == modes.size())
    found = best(modes,
                 [](const drmModeModeInfo& m) { return (m.type & DRM_MODE_TYPE_PREFERRED) != 0; });
  if (found == modes.size())
    found = best(modes, [&](const drmModeModeInfo& m) {
      return m.hdisplay <= wish.width && m.vdisplay <= wish.height;
    });
  return found == modes.size() ? 0 : found;
}

std::int64_t period_us(const drmModeModeInfo& mode) {
  if (mode.clock == 0 || mode.htotal == 0 || mode.vtotal == 0) return k60Hz_us;
  const std::int64_t pixels = std::int64_t{mode.htotal} * mode.vtotal;
  const std::int64_t frame_us = pixels * 1000 / mode.clock;  // The clock counts kHz.
  return interlaced(mode) ? frame_us / 2 : frame_us;
}

}  // namespace caryatid::platform::gbm
