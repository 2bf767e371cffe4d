#include "core/emotion/place.h"

#include <algorithm>

namespace caryatid::emotion {
namespace {

constexpr std::array<Place, kEmotionCount> kPlaces{{{0, 0},
                                                    {0.45f, 0.8f},
                                                    {-0.1f, -0.55f},
                                                    {0.1f, -0.5f},
                                                    {0.3f, -0.2f},
                                                    {0.35f, -0.3f},
                                                    {0.6f, 0.3f}}};

}  // namespace

Place place_of(const Weights& weights) {
  Place sum;
  for (std::size_t e = 1; e < kEmotionCount; ++e) {
    sum.activation += weights[e] * kPlaces[e].activation;
    sum.evaluation += weights[e] * kPlaces[e].evaluation;
  }
  return {std::clamp(sum.activation, -1.0f, 1.0f), std::clamp(sum.evaluation, -1.0f, 1.0f)};
}

}  // namespace caryatid::emotion
