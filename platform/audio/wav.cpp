#include "platform/audio/wav.h"

#include <algorithm>
#include <cstring>

namespace caryatid::platform {
namespace {

std::uint32_t number(std::span<const std::byte> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i > 0; --i)
    value = value << 8u | std::to_integer<std::uint32_t>(bytes[at + i - 1]);
  return value;
}

bool is(std::span<const std::byte> bytes, std::size_t at, const char* name) {
  return at + 4 <= bytes.size() && std::memcmp(bytes.data() + at, name, 4) == 0;
}

Status refuse(WavRefusal why) { return {Code::corrupt_data, static_cast<std::uint16_t>(why)}; }

bool read_format(std::span<const std::byte> bytes, std::size_t at, WavFormat* out) {
  constexpr std::uint32_t kPcm = 1, kExtensible = 0xFFFE;
  const std::uint32_t tag = number(bytes, at, 2);
  out->channels = static_cast<std::uint16_t>(number(bytes, at + 2, 2));
  out->rate_hz = number(bytes, at + 4, 4);
  const std::uint32_t frame_bytes = number(bytes, at + 12, 2);
  const std::uint32_t bits = number(bytes, at + 14, 2);
  return (tag == kPcm || tag == kExtensible) && bits == 16 && out->channels >= 1 &&
         out->channels <= 2 && frame_bytes == 2u * out->channels && out->rate_hz >= 8000 &&
         out->rate_hz <= 96000;
}

void put(std::uint32_t value, std::size_t size, std::byte* at) {
  for (std::size_t i = 0; i < size; ++i) at[i] = static_cast<std::byte>(value >> (8 * i) & 0xFFu);
}

}  // namespace

const char* wav_refusal_text(WavRefusal refusal) {
  constexpr const char* kTexts[] = {"is fine",
                                    "is no WAV file",
                                    "has no format before its sound",
                                    "holds no sound",
                                    "is not 16-bit PCM with 1 or 2 channels at 8000 to 96000 Hz",
                                    "promises more sound than it holds"};
  const auto i = static_cast<std::size_t>(refusal);
  return kTexts[i < std::size(kTexts) ? i : 0];
}

Status parse_wav(std::span<const std::byte> start, std::uint64_t file_bytes, WavFormat* out) {
  *out = {};
  const auto bytes = start.first(std::min<std::size_t>(start.size(), 65536));
  if (!is(bytes, 0, "RIFF") || !is(bytes, 8, "WAVE")) return refuse(WavRefusal::no_riff);
  bool known = false;
  for (std::uint64_t at = 12; at + 8 <= bytes.size();) {
    const auto here = static_cast<std::size_t>(at);
    const std::uint64_t size = number(bytes, here + 4, 4);
    if (is(bytes, here, "fmt ")) {
      if (size < 16 || here + 8 + 16 > bytes.size()) return refuse(WavRefusal::no_format);
      if (!read_format(bytes, here + 8, out)) return refuse(WavRefusal::bad_format);
      known = true;
    } else if (is(bytes, here, "data")) {
      if (!known) return refuse(WavRefusal::no_format);
      if (at + 8 + size > file_bytes) return refuse(WavRefusal::lying_length);
      out->data_offset = at + 8;
      out->frames = size / (2u * out->channels);
      return out->frames > 0 ? Status{} : refuse(WavRefusal::no_data);
    }
    at += 8 + size + (size & 1u);
  }
  return refuse(known ? WavRefusal::no_data : WavRefusal::no_format);
}

std::array<std::byte, kWavHeadBytes> wav_head(std::uint32_t rate_hz, std::uint32_t frames) {
  std::array<std::byte, kWavHeadBytes> head{};
  std::byte* at = head.data();
  std::memcpy(at, "RIFF", 4);
  put(2 * frames + 36, 4, at + 4);
  std::memcpy(at + 8, "WAVEfmt ", 8);
  put(16, 4, at + 16);
  put(1, 2, at + 20);
  put(1, 2, at + 22);
  put(rate_hz, 4, at + 24);
  put(2 * rate_hz, 4, at + 28);
  put(2, 2, at + 32);
  put(16, 2, at + 34);
  std::memcpy(at + 36, "data", 4);
  put(2 * frames, 4, at + 40);
  return head;
}

}  // namespace caryatid::platform
