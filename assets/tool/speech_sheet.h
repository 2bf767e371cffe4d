#pragma once
// Pictures of a person who speaks.
#include "assets/tool/spoken.h"
#include "assets/tool/studio.h"

namespace caryatid::tool {

// The face of a moment as the kiosk would show it, framed to the head (mouth: to its lower half).
struct SpeechShot {
  std::int32_t time_ms = 0;
  bool mouth_only = false;
  face::FapFrame mood = {};  // Added to the calm face.
};
Picture speech_picture(const Spoken& spoken, const SpeechShot& shot, Studio* studio);

// Rows of frames, 80 ms each, with the words, the phonemes and the waveform under them in time.
Picture speech_strip(const Spoken& spoken, const std::string& text, std::uint32_t cell,
                     Studio* studio);

}  // namespace caryatid::tool
