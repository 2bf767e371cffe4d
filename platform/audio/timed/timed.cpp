// The file and null backends: sound passes at the pace of a clock, into a WAV or into nothing.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>

#include "platform/audio/backends.h"
#include "platform/audio/ring.h"
#include "platform/audio/wav.h"

namespace caryatid::platform {
namespace {

class TimedAudio final : public Audio {
 public:
  explicit TimedAudio(std::uint32_t rate_hz) : rate_hz_(rate_hz) {}
  ~TimedAudio() override;
  bool open_file(const char* path);

  std::size_t room() const override { return ring_.room(); }
  std::size_t write(std::span<const std::int16_t> samples) override { return ring_.write(samples); }
  std::int64_t heard(std::int64_t now_us) override {
    update(now_us);
    return ring_.taken() - base_;
  }
  void flush() override {
    ring_.skip_to(ring_.written());
    base_ = ring_.written();
    finished_ = false;
  }
  void finish() override { finished_ = true; }
  void set_volume(float volume) override {
    volume_.set(volume < 0 ? 0 : (volume > 1 ? 1 : volume));
  }
  void update(std::int64_t now_us) override;
  std::uint32_t rate_hz() const override { return rate_hz_; }
  AudioCounts counts() const override { return counts_; }
  bool present() const override { return true; }

 private:
  void put(std::span<const std::int16_t> samples);

  SampleRing<kRingSamples> ring_;
  VolumeRamp volume_;
  std::uint32_t rate_hz_;
  std::FILE* file_ = nullptr;
  std::uint32_t file_samples_ = 0;
  std::int64_t start_us_ = -1;
  std::int64_t passed_ = 0;  // Samples since the start, silence included.
  std::int64_t base_ = 0;    // Of the ring, at the last flush.
  bool finished_ = false, dry_ = false;
  AudioCounts counts_;
};

bool TimedAudio::open_file(const char* path) {
  file_ = std::fopen(path, "wb");
  if (file_ == nullptr) return false;
  const auto head = wav_head(rate_hz_, 0);
  return std::fwrite(head.data(), 1, head.size(), file_) == head.size();
}

TimedAudio::~TimedAudio() {
  if (file_ == nullptr) return;
  // Now the length is known.
  const auto head = wav_head(rate_hz_, file_samples_);
  std::rewind(file_);
  (void)std::fwrite(head.data(), 1, head.size(), file_);
  std::fclose(file_);
}

// Little-endian, as every machine that Caryatid runs on. A full disk costs the file, not the show.
void TimedAudio::put(std::span<const std::int16_t> samples) {
  constexpr std::uint32_t kMostSamples = 0x7FFFFF00u / 2;  // Of a WAV that every program reads.
  if (file_ == nullptr || file_samples_ + samples.size() > kMostSamples) return;
  if (std::fwrite(samples.data(), 2, samples.size(), file_) == samples.size())
    file_samples_ += static_cast<std::uint32_t>(samples.size());
}

void TimedAudio::update(std::int64_t now_us) {
  if (start_us_ < 0) start_us_ = now_us;
  const std::int64_t due = (now_us - start_us_) * rate_hz_ / 1'000'000;
  std::int16_t piece[512];
  while (passed_ < due) {
    const auto want = static_cast<std::size_t>(due - passed_ < 512 ? due - passed_ : 512);
    const std::size_t got = ring_.read({piece, want});
    volume_.apply({piece, got}, rate_hz_);
    const bool inside = !finished_ && ring_.taken() > base_;
    if (got < want) std::memset(piece + got, 0, (want - got) * sizeof piece[0]);
    const bool dry = got < want && inside;
    if (dry && !dry_) ++counts_.underruns;
    dry_ = dry;
    put({piece, want});
    passed_ += static_cast<std::int64_t>(want);
  }
}

}  // namespace

Status open_timed_audio(const AudioOptions& options, const char* path, std::unique_ptr<Audio>& out,
                        ErrorLine& out_error) {
  std::unique_ptr<TimedAudio> audio(new (std::nothrow) TimedAudio(options.rate_hz));
  if (audio == nullptr || (path != nullptr && !audio->open_file(path))) {
    const std::string line = std::string(path != nullptr ? path : "audio") + ": " +
                             std::strerror(errno) + "; name a file that can be written";
    out_error = ErrorLine(line);
    return {Code::io, 0};
  }
  out = std::move(audio);
  return {};
}

}  // namespace caryatid::platform
