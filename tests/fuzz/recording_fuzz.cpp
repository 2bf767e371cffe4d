// Recordings: a WAV's head and the lines of a timing file.
#include <span>
#include <string_view>

#include "platform/audio/wav.h"
#include "platform/voice/recorded/recorded.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace platform = caryatid::platform;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  platform::WavFormat format;
  if (platform::parse_wav(bytes, size, &format).ok()) {
    const std::uint64_t end = format.data_offset + 2 * format.channels * format.frames;
    if (format.frames == 0 || end > size) __builtin_trap();
  }
  std::string_view text(reinterpret_cast<const char*>(data), size);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    platform::TimingLine line;
    if (platform::parse_timing_line(text.substr(0, end), &line) &&
        (line.time_ms < 0 || line.end_byte < line.begin_byte))
      __builtin_trap();
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return 0;
}
