#pragma once
// The service that plays sound and knows what has been heard. Backends: alsa (a real-time thread
// behind a lock-free ring), file (a WAV), null (plays to nobody, in time). Mono samples go in; the
// device may have one channel or two.
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/base/status.h"
#include "platform/error_line.h"

namespace caryatid::platform {

struct AudioOptions {
  std::string_view kind = "auto";  // auto, alsa, alsa:DEVICE, file:PATH, null.
  std::uint32_t rate_hz = 22050;   // Of what is written; 8000..48000. The device may resample.
  // Sound advances with the time that is given to update(), not with a clock: replays of a kiosk
  // are the same bit for bit. file and null alone; auto then takes null.
  bool lockstep = false;
};

// What the device went through since it was opened.
struct AudioCounts {
  std::uint32_t underruns = 0;  // The ring ran dry inside a stream, or ALSA reported an xrun.
  std::uint32_t losses = 0;     // The device went away.
};

// Positions count the samples that were written since the last flush(). One thread calls.
class Audio {
 public:
  virtual ~Audio() = default;

  // How many samples write() takes now.
  virtual std::size_t room() const = 0;
  // Queues samples; returns how many fitted.
  virtual std::size_t write(std::span<const std::int16_t> samples) = 0;
  // Samples queued since flush() that have been heard at `now_us`: never falls, never exceeds what
  // was written, and stands still while there is nothing to play. While the device is away, sound
  // passes unheard at its pace: the show goes on.
  virtual std::int64_t heard(std::int64_t now_us) = 0;
  // Forgets what was queued; silence within 50 ms. Positions start again at 0.
  virtual void flush() = 0;
  // Nothing follows what was written: running dry is no underrun. flush() ends that.
  virtual void finish() = 0;
  // 0..1, a factor of the samples; changes take 50 ms. Any value outside is cut.
  virtual void set_volume(float volume) = 0;
  // Once a frame: moves file and null on.
  virtual void update(std::int64_t now_us) = 0;

  virtual std::uint32_t rate_hz() const = 0;
  virtual AudioCounts counts() const = 0;
  // False while the device is away (unplugged); it is tried again ever more slowly.
  virtual bool present() const = 0;
};

// auto: ALSA's default device, else null. All memory and threads are taken here.
// unsupported: no such kind, or alsa in a build without it. io: the file or device can't be opened.
Status open_audio(const AudioOptions& options, std::unique_ptr<Audio>& out, ErrorLine& out_error);

}  // namespace caryatid::platform
