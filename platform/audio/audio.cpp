#include "platform/audio/audio.h"

#include <string>

#include "platform/audio/backends.h"

namespace caryatid::platform {
namespace {

Status open_alsa(const AudioOptions& options, const char* device, std::unique_ptr<Audio>& out,
                 ErrorLine& out_error) {
#ifdef CARYATID_AUDIO_ALSA
  if (!options.lockstep) return open_alsa_audio(options, device, out, out_error);
  out_error = ErrorLine(std::string_view(
      "audio alsa: plays in real time, which --virtual-clock has not; take file:PATH or null"));
#else
  (void)options, (void)device, (void)out;
  out_error = ErrorLine(std::string_view(
      "audio alsa: this build has no ALSA; install libasound2-dev and build again"));
#endif
  return {Code::unsupported, 0};
}

}  // namespace

Status open_audio(const AudioOptions& options, std::unique_ptr<Audio>& out, ErrorLine& out_error) {
  const std::string kind(options.kind);
  if (kind == "null") return open_timed_audio(options, nullptr, out, out_error);
  if (kind.starts_with("file:") && kind.size() > 5)
    return open_timed_audio(options, kind.c_str() + 5, out, out_error);
  if (kind == "alsa") return open_alsa(options, "default", out, out_error);
  if (kind.starts_with("alsa:") && kind.size() > 5)
    return open_alsa(options, kind.c_str() + 5, out, out_error);
  if (kind == "auto") {
    if (!options.lockstep && open_alsa(options, "default", out, out_error).ok()) return {};
    return open_timed_audio(options, nullptr, out, out_error);
  }
  out_error =
      ErrorLine("audio " + kind + ": no such kind; auto, alsa, alsa:DEVICE, file:PATH, null");
  return {Code::unsupported, 0};
}

}  // namespace caryatid::platform
