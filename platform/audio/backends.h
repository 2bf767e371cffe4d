#pragma once
// The backends that open_audio() chooses from.
#include "platform/audio/audio.h"

namespace caryatid::platform {

// A WAV at `path`, or nothing at all (nullptr), at the pace of the clock.
Status open_timed_audio(const AudioOptions& options, const char* path, std::unique_ptr<Audio>& out,
                        ErrorLine& out_error);
// device: ALSA's name of a PCM ("default", "plughw:1,0").
Status open_alsa_audio(const AudioOptions& options, const char* device, std::unique_ptr<Audio>& out,
                       ErrorLine& out_error);

}  // namespace caryatid::platform
