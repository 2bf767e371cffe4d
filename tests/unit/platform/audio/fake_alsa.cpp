#include "tests/unit/platform/audio/fake_alsa.h"

#include <alsa/asoundlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "platform/clock/clock.h"

using caryatid::platform::FakeAlsa;
using caryatid::platform::monotonic_us;

struct _snd_pcm {
  unsigned rate = 0, channels = 0;
  std::int64_t written = 0, start_us = -1;
  static constexpr std::int64_t kBuffer = 880, kPeriod = 220;

  std::int64_t played() const {
    return start_us < 0 ? 0 : std::min((monotonic_us() - start_us) * rate / 1'000'000, written);
  }
};

FakeAlsa& FakeAlsa::get() {
  static FakeAlsa fake;
  return fake;
}

void FakeAlsa::reset() {
  plugged = mono = true;
  stuck = false;
  underruns_due = opens = recovers = 0;
  const std::lock_guard lock(mutex);
  played.clear();
}

extern "C" {

int snd_pcm_open(snd_pcm_t** pcm, const char*, snd_pcm_stream_t, int) {
  if (!FakeAlsa::get().plugged) return -ENODEV;
  ++FakeAlsa::get().opens;
  *pcm = new _snd_pcm;
  return 0;
}

int snd_pcm_close(snd_pcm_t* pcm) {
  delete pcm;
  return 0;
}

int snd_pcm_set_params(snd_pcm_t* pcm, snd_pcm_format_t, snd_pcm_access_t, unsigned channels,
                       unsigned rate, int, unsigned) {
  if (channels == 1 && !FakeAlsa::get().mono) return -EINVAL;
  pcm->channels = channels;
  pcm->rate = rate;
  return 0;
}

int snd_pcm_get_params(snd_pcm_t*, snd_pcm_uframes_t* buffer, snd_pcm_uframes_t* period) {
  *buffer = _snd_pcm::kBuffer;
  *period = _snd_pcm::kPeriod;
  return 0;
}

int snd_pcm_wait(snd_pcm_t* pcm, int timeout_ms) {
  for (std::int64_t until = monotonic_us() + timeout_ms * 1000; monotonic_us() < until;) {
    if (!FakeAlsa::get().plugged) return -ENODEV;
    if (!FakeAlsa::get().stuck &&
        _snd_pcm::kBuffer - (pcm->written - pcm->played()) >= _snd_pcm::kPeriod)
      return 1;
    usleep(1000);
  }
  return 0;
}

snd_pcm_sframes_t snd_pcm_writei(snd_pcm_t* pcm, const void* from, snd_pcm_uframes_t frames) {
  FakeAlsa& fake = FakeAlsa::get();
  if (!fake.plugged) return -ENODEV;
  if (fake.underruns_due > 0) {
    --fake.underruns_due;
    return -EPIPE;
  }
  const std::int64_t room = _snd_pcm::kBuffer - (pcm->written - pcm->played());
  if (room <= 0 || fake.stuck) return -EAGAIN;
  const auto n = std::min<std::int64_t>(room, static_cast<std::int64_t>(frames));
  const auto* samples = static_cast<const std::int16_t*>(from);
  const std::lock_guard lock(fake.mutex);
  for (std::int64_t i = 0; i < n; ++i) fake.played.push_back(samples[i * pcm->channels]);
  if (pcm->start_us < 0) pcm->start_us = monotonic_us();
  pcm->written += n;
  return static_cast<snd_pcm_sframes_t>(n);
}

int snd_pcm_recover(snd_pcm_t*, int error, int) {
  ++FakeAlsa::get().recovers;
  return error == -EPIPE || error == -EINTR || error == -ESTRPIPE ? 0 : error;
}

int snd_pcm_delay(snd_pcm_t* pcm, snd_pcm_sframes_t* delay) {
  *delay = static_cast<snd_pcm_sframes_t>(pcm->written - pcm->played());
  return 0;
}

const char* snd_strerror(int) { return "fake"; }

}  // extern "C"
