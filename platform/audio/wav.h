#pragma once
// WAV files (RIFF, 16-bit PCM), as much of them as Caryatid reads and writes.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/status.h"

namespace caryatid::platform {

struct WavFormat {
  std::uint32_t rate_hz = 0;
  std::uint16_t channels = 0;
  std::uint64_t data_offset = 0;  // Of the first sample in the file.
  std::uint64_t frames = 0;       // Samples of one channel.
};

// Why a file is refused (Status::detail).
enum class WavRefusal : std::uint16_t {
  none,
  no_riff,       // Not a WAV at all.
  no_format,     // The fmt chunk is missing or comes after the sound.
  no_data,       // There is no data chunk within the first 64 KiB, or it is empty.
  bad_format,    // Not 16-bit PCM, not 1 or 2 channels, or not 8000..96000 Hz.
  lying_length,  // It promises more sound than the file holds.
};
const char* wav_refusal_text(WavRefusal refusal);

// Reads the head. `start`: the file's first bytes, at most 64 KiB are looked at; file_bytes: its
// true length. Never trusts a length.
Status parse_wav(std::span<const std::byte> start, std::uint64_t file_bytes, WavFormat* out);

inline constexpr std::size_t kWavHeadBytes = 44;
// The head of a mono file with `frames` samples.
std::array<std::byte, kWavHeadBytes> wav_head(std::uint32_t rate_hz, std::uint32_t frames);

}  // namespace caryatid::platform
