#include "core/speech/prosody.h"

namespace caryatid::speech {

Prosody prosody_at(float activation, float evaluation) {
  constexpr float kPace = 0.5f;
  return {.rate = 1.0f + kPace * (0.5f * activation + 0.2f * evaluation),
          .pitch = 1.0f + 0.3f * activation + 0.1f * evaluation,
          .range = 1.0f + activation};
}

}  // namespace caryatid::speech
