#include "core/lod/share.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace caryatid::lod {

float weight_of(const ObjectNeed& need) {
  const float place = 0.4f + 0.6f * std::clamp(need.axis_closeness, 0.0f, 1.0f);
  const float motion = 1.0f + std::clamp(need.expression, 0.0f, 1.0f);
  return std::max(need.importance, 0.0f) * std::max(need.screen_px, 0.0f) * place * motion;
}

float share_budget(std::span<const ObjectNeed> objects, std::span<const float> triangle_us,
                   float budget_us, std::span<std::uint32_t> out) {
  const std::size_t count = std::min<std::size_t>(objects.size(), kMaxObjects);
  assert(triangle_us.size() >= count && out.size() >= count);
  std::array<float, kMaxObjects> slope{}, least{}, most{};
  float lambda_max = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    slope[i] = std::sqrt(weight_of(objects[i]) / triangle_us[i]);
    least[i] = static_cast<float>(objects[i].min_triangles);
    most[i] = std::max(static_cast<float>(objects[i].max_triangles), least[i]);
    if (slope[i] > 0.0f) lambda_max = std::max(lambda_max, most[i] / slope[i]);
  }
  const auto cost_at = [&](float lambda) {
    float us = 0.0f;
    for (std::size_t i = 0; i < count; ++i)
      us += triangle_us[i] * std::clamp(lambda * slope[i], least[i], most[i]);
    return us;
  };
  float low = 0.0f, high = lambda_max;
  if (cost_at(high) <= budget_us) {
    low = high;
  } else {
    for (int step = 0; step < 24; ++step) {
      const float middle = 0.5f * (low + high);
      (cost_at(middle) <= budget_us ? low : high) = middle;
    }
  }
  float spent = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = static_cast<std::uint32_t>(std::clamp(low * slope[i], least[i], most[i]));
    spent += triangle_us[i] * static_cast<float>(out[i]);
  }
  return spent;
}

}  // namespace caryatid::lod
