#include "core/face/fat.h"

#include <algorithm>

namespace caryatid::face {
namespace {

float value_of(const FapFrame& frame, std::uint16_t fap) {
  return fap <= kFapCount ? frame.value[fap] : 0.0f;
}

}  // namespace

Status evaluate_channels(std::span<const pack::Channel> channels, const FapFrame& frame,
                         std::span<float> out_weight) {
  if (out_weight.size() < channels.size()) return {Code::out_of_capacity};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const pack::Channel& channel = channels[i];
    float c = ramp(value_of(frame, channel.fap), channel.from, channel.to);
    if (channel.partner != 0 && c > 0.0f)
      c *= ramp(value_of(frame, channel.partner), channel.partner_from, channel.partner_to);
    out_weight[i] = c;
  }
  return {};
}

FapLimits limits_of(std::span<const pack::Channel> channels) {
  FapLimits limits;
  for (const pack::Channel& channel : channels) {
    if (channel.partner != 0 || channel.fap > kFapCount) continue;
    limits.low[channel.fap] = std::min(limits.low[channel.fap], channel.to);
    limits.high[channel.fap] = std::max(limits.high[channel.fap], channel.to);
  }
  return limits;
}

float soften(float value, float low, float high) {
  if (!(value == value)) return 0.0f;
  const float limit = value < 0.0f ? -low : high;
  if (!(limit > 0.0f)) return 0.0f;
  const float magnitude = std::min(value < 0.0f ? -value : value, 1e7f);
  const float working = limit / kReach;
  if (magnitude <= working) return value;
  const float t = (magnitude - working) / (limit - working);
  const float softened = working + (limit - working) * (t / (1.0f + t));
  return value < 0.0f ? -softened : softened;
}

}  // namespace caryatid::face
