// ALSA: a real-time thread moves samples from a lock-free ring into the device and publishes how
// far they have been heard. The device runs on silence between utterances, because many (HDMI above
// all) swallow the first half second after a start.
#include <alsa/asoundlib.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>

#include "platform/audio/backends.h"
#include "platform/audio/ring.h"
#include "platform/clock/clock.h"
#include "platform/retry.h"

namespace caryatid::platform {
namespace {

constexpr unsigned kBuffer_us =
    40'000;                     // In the device: what a flush leaves, and a stall may take.
constexpr int kStuck_ms = 500;  // A device that takes nothing for so long is lost.
constexpr std::int64_t kTick_us = 10'000;  // Pace of the show while there is no device.
constexpr std::size_t kMostPeriod = 2048;  // Frames moved at once, at most.
constexpr int kPriority = 20;              // SCHED_FIFO; below the kernel's own audio threads (50).

// Where the ring's samples lie among the frames that went into the device.
struct Piece {
  std::int64_t device = 0;  // Number of its first frame since the device was opened.
  std::int64_t ring = 0;    // Position of that frame's sample; silence follows the samples.
  std::int64_t samples = 0;
};

// Written by the sound thread, read by the caller: a sequence lock, odd while it is being written.
struct Published {
  std::atomic<std::uint32_t> sequence{0};
  std::atomic<std::int64_t> heard{0}, limit{0}, time_us{0};

  void set(std::int64_t position, std::int64_t most, std::int64_t now_us) {
    sequence.fetch_add(1, std::memory_order_acq_rel);
    heard.store(position, std::memory_order_relaxed);
    limit.store(most, std::memory_order_relaxed);
    time_us.store(now_us, std::memory_order_relaxed);
    sequence.fetch_add(1, std::memory_order_release);
  }
  // The position at `now_us`, moved on from when it was published.
  std::int64_t at(std::int64_t now_us, std::uint32_t rate_hz) const {
    for (;;) {
      const std::uint32_t before = sequence.load(std::memory_order_acquire);
      const std::int64_t position = heard.load(std::memory_order_relaxed);
      const std::int64_t most = limit.load(std::memory_order_relaxed);
      const std::int64_t since_us = now_us - time_us.load(std::memory_order_relaxed);
      std::atomic_thread_fence(std::memory_order_acquire);
      if (before % 2 != 0 || sequence.load(std::memory_order_relaxed) != before) continue;
      const std::int64_t moved =
          std::clamp<std::int64_t>(since_us, 0, 100'000) * rate_hz / 1'000'000;
      return std::min(position + moved, most);
    }
  }
};

class AlsaAudio final : public Audio {
 public:
  AlsaAudio(const char* device, std::uint32_t rate_hz) : device_(device), rate_hz_(rate_hz) {}
  ~AlsaAudio() override;

  // 0, or ALSA's negative error.
  int open_device();
  bool start_thread();

  std::size_t room() const override { return ring_.room(); }
  std::size_t write(std::span<const std::int16_t> samples) override { return ring_.write(samples); }
  std::int64_t heard(std::int64_t now_us) override {
    latest_ = std::max(latest_, published_.at(now_us, rate_hz_));
    return std::max<std::int64_t>(latest_ - base_, 0);
  }
  void flush() override {
    base_ = ring_.written();
    latest_ = base_;
    finished_.store(false, std::memory_order_relaxed);
    skip_to_.store(base_, std::memory_order_release);
  }
  void finish() override { finished_.store(true, std::memory_order_relaxed); }
  void set_volume(float volume) override { volume_.set(std::clamp(volume, 0.0f, 1.0f)); }
  void update(std::int64_t) override {}
  std::uint32_t rate_hz() const override { return rate_hz_; }
  AudioCounts counts() const override {
    return {underruns_.load(std::memory_order_relaxed), losses_.load(std::memory_order_relaxed)};
  }
  bool present() const override { return present_.load(std::memory_order_relaxed); }

 private:
  static void* thread_main(void* self) {
    static_cast<AlsaAudio*>(self)->run();
    return nullptr;
  }
  void run();
  int play_period();
  void keep_pace();
  void be_away();
  void lose();
  std::size_t take(std::size_t frames);
  int put(std::size_t frames);
  int recover(int error);
  void publish();

  std::string device_;
  std::uint32_t rate_hz_;
  SampleRing<kRingSamples> ring_;
  VolumeRamp volume_;
  Published published_;
  std::atomic<std::int64_t> skip_to_{0};
  std::atomic<bool> finished_{true}, stop_{false}, present_{false};
  std::atomic<std::uint32_t> underruns_{0}, losses_{0};
  pthread_t thread_{};
  bool running_ = false;
  // The caller's.
  std::int64_t base_ = 0, latest_ = 0;
  // The thread's.
  snd_pcm_t* pcm_ = nullptr;
  unsigned channels_ = 1;
  bool dry_ = false;
  std::size_t period_ = 256;
  std::int64_t device_frames_ = 0;
  int recoveries_ = 0;                                // Since a period went into the device whole.
  std::int64_t pace_since_us_ = 0, pace_frames_ = 0;  // Of keep_pace().
  std::array<Piece, 32> pieces_{};
  std::size_t next_piece_ = 0;
  std::array<std::int16_t, kMostPeriod> mono_{};
  std::array<std::int16_t, 2 * kMostPeriod> stereo_{};
  Retry retry_;
};

AlsaAudio::~AlsaAudio() {
  stop_ = true;
  if (running_) pthread_join(thread_, nullptr);
  if (pcm_ != nullptr) snd_pcm_close(pcm_);
}

int AlsaAudio::open_device() {
  int error = snd_pcm_open(&pcm_, device_.c_str(), SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
  if (error < 0) {
    pcm_ = nullptr;
    return error;
  }
  for (channels_ = 1; channels_ <= 2; ++channels_) {
    error = snd_pcm_set_params(pcm_, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, channels_,
                               rate_hz_, 1, kBuffer_us);
    if (error >= 0) break;
  }
  snd_pcm_uframes_t buffer = 0, period = 0;
  if (error >= 0) error = snd_pcm_get_params(pcm_, &buffer, &period);
  if (error < 0) {
    snd_pcm_close(pcm_);
    pcm_ = nullptr;
    return error;
  }
  period_ = std::clamp<std::size_t>(period, 64, kMostPeriod);
  device_frames_ = 0;
  pieces_.fill({});
  present_.store(true, std::memory_order_relaxed);
  return 0;
}

bool AlsaAudio::start_thread() {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_FIFO);
  sched_param priority{};
  priority.sched_priority = kPriority;
  pthread_attr_setschedparam(&attributes, &priority);
  int error = pthread_create(&thread_, &attributes, thread_main, this);
  // Without the right to real time (RLIMIT_RTPRIO) the buffer has to do.
  if (error != 0) error = pthread_create(&thread_, nullptr, thread_main, this);
  pthread_attr_destroy(&attributes);
  running_ = error == 0;
  return running_;
}

void AlsaAudio::run() {
  while (!stop_.load(std::memory_order_relaxed)) {
    if (pcm_ == nullptr)
      be_away();
    else if (play_period() < 0)
      lose();
  }
}

void AlsaAudio::lose() {
  snd_pcm_close(pcm_);
  pcm_ = nullptr;
  present_.store(false, std::memory_order_relaxed);
  losses_.fetch_add(1, std::memory_order_relaxed);
  retry_.start(monotonic_us());
}

// The show goes on without the device: what would be heard passes unheard.
void AlsaAudio::be_away() {
  const std::int64_t now_us = monotonic_us();
  (void)take(std::min<std::size_t>(rate_hz_ * static_cast<std::size_t>(kTick_us) / 1'000'000,
                                   kMostPeriod));
  published_.set(ring_.taken(), ring_.taken(), now_us);
  if (retry_.due(now_us)) {
    if (open_device() == 0) return;
    retry_.failed(now_us);
  }
  sleep_until_us(now_us + kTick_us);
}

// The next samples of the ring into mono_, silence behind them; returns how many there were.
std::size_t AlsaAudio::take(std::size_t frames) {
  ring_.skip_to(skip_to_.load(std::memory_order_acquire));
  const std::int64_t before = ring_.taken();
  const std::size_t got = ring_.read({mono_.data(), frames});
  volume_.apply({mono_.data(), got}, rate_hz_);
  std::fill(mono_.begin() + static_cast<std::ptrdiff_t>(got),
            mono_.begin() + static_cast<std::ptrdiff_t>(frames), std::int16_t{0});
  const bool inside = !finished_.load(std::memory_order_relaxed) &&
                      before > skip_to_.load(std::memory_order_relaxed);
  const bool dry = inside && got < frames;
  if (dry && !dry_) underruns_.fetch_add(1, std::memory_order_relaxed);
  dry_ = dry;
  return got;
}

// 0, or ALSA's error when the device is lost.
int AlsaAudio::recover(int error) {
  constexpr int kHopeless = 8;
  if (error == -EPIPE) underruns_.fetch_add(1, std::memory_order_relaxed);
  if (++recoveries_ > kHopeless) return -EIO;
  return snd_pcm_recover(pcm_, error, 1);
}

// 0 when all of it went into the device.
int AlsaAudio::put(std::size_t frames) {
  const std::int16_t* from = mono_.data();
  if (channels_ == 2) {
    for (std::size_t i = 0; i < frames; ++i) stereo_[2 * i] = stereo_[2 * i + 1] = mono_[i];
    from = stereo_.data();
  }
  for (std::size_t done = 0; done < frames;) {
    snd_pcm_sframes_t n = snd_pcm_writei(pcm_, from + done * channels_, frames - done);
    if (n == -EAGAIN) {
      n = snd_pcm_wait(pcm_, kStuck_ms);
      if (n == 0) return -EIO;  // Stuck.
      if (n == 1) continue;
    }
    if (n < 0) {
      if (const int error = recover(static_cast<int>(n)); error < 0) return error;
      continue;
    }
    done += static_cast<std::size_t>(n);
    device_frames_ += n;
  }
  return 0;
}

int AlsaAudio::play_period() {
  const int before = recoveries_;
  const int room = snd_pcm_wait(pcm_, kStuck_ms);
  if (room == 0) return -EIO;
  if (room < 0) {
    if (const int error = recover(room); error < 0) return error;
  }
  ring_.skip_to(skip_to_.load(std::memory_order_acquire));
  const std::int64_t ring_position = ring_.taken();
  const std::size_t got = take(period_);
  pieces_[next_piece_] = {device_frames_, ring_position, static_cast<std::int64_t>(got)};
  next_piece_ = (next_piece_ + 1) % pieces_.size();
  if (const int error = put(period_); error < 0) return error;
  if (recoveries_ == before) recoveries_ = 0;
  publish();
  keep_pace();
  return 0;
}

// A device without a clock (ALSA's null, and what is built on it) takes everything at once: this
// thread, which has real-time priority, would never let go of its core.
void AlsaAudio::keep_pace() {
  constexpr std::int64_t kWindow_us = 1'000'000;
  // A real card is never 5 % too fast; at its start it takes its whole buffer.
  const auto passed_us = [this](std::int64_t frames) {
    return frames * 950'000 / static_cast<std::int64_t>(rate_hz_);
  };
  const std::int64_t now_us = monotonic_us();
  pace_frames_ += static_cast<std::int64_t>(period_);
  const std::int64_t earliest_us = pace_since_us_ + passed_us(pace_frames_) - 2 * kBuffer_us;
  if (now_us < earliest_us) sleep_until_us(earliest_us);
  if (now_us - pace_since_us_ < kWindow_us) return;
  pace_since_us_ = now_us;
  pace_frames_ = 0;
}

void AlsaAudio::publish() {
  snd_pcm_sframes_t delay = 0;
  if (snd_pcm_delay(pcm_, &delay) < 0) delay = 0;
  const std::int64_t heard_frame = device_frames_ - std::max<std::int64_t>(delay, 0);
  std::int64_t heard = -1, oldest = ring_.taken();
  for (const Piece& p : pieces_) {
    if (p.device <= heard_frame && p.ring >= heard)
      heard = p.ring + std::min(heard_frame - p.device, p.samples);
    oldest = std::min(oldest, p.ring);
  }
  published_.set(heard >= 0 ? heard : oldest, ring_.taken(), monotonic_us());
}

}  // namespace

Status open_alsa_audio(const AudioOptions& options, const char* device, std::unique_ptr<Audio>& out,
                       ErrorLine& out_error) {
  std::unique_ptr<AlsaAudio> audio(new (std::nothrow) AlsaAudio(device, options.rate_hz));
  const int error = audio == nullptr ? -ENOMEM : audio->open_device();
  if (error < 0 || !audio->start_thread()) {
    const std::string line = std::string("audio device ") + device + ": " + snd_strerror(error) +
                             "; aplay -L lists devices, --audio alsa:NAME takes one";
    out_error = ErrorLine(line);
    return {Code::io, 0};
  }
  out = std::move(audio);
  return {};
}

}  // namespace caryatid::platform
