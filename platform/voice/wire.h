#pragma once
// The language between the kiosk and its voice program: records on a stream of bytes, each way.
//
// A record: type (1 byte), 0 (1 byte), size of what follows the head (2 bytes), number of the
// utterance (4 bytes), then `size` bytes. All numbers little-endian. Times are milliseconds of the
// utterance's own sound; an event is sent before the sound that it is about.
//
//   voice -> kiosk                                   kiosk -> voice
//   hello     u32 version, u32 samples a second      say     u8 ssml, u8 bytes of language,
//   pcm       i16 samples, mono                              u16 rate, u16 pitch, u16 range
//   phone     i32 time, IPA in UTF-8                         (percent), language, text in UTF-8
//   word      i32 time, u32 first byte, u32 end      cancel  (no payload)
//   mark      i32 time, name
//   sentence  i32 time
//   end       i32 time
//   refused   u8 VoiceTrouble
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/limits.h"
#include "core/base/status.h"

namespace caryatid::platform::wire {

inline constexpr std::uint32_t kVersion = 2;
inline constexpr std::size_t kHeadBytes = 8;
inline constexpr std::size_t kMostPcmBytes = 4096;
inline constexpr std::size_t kMostNameBytes = 32;
// The longest record is a say: its numbers, a language and the text.
inline constexpr std::size_t kSayBytes = 8;
inline constexpr std::size_t kMostBytes = kSayBytes + 31 + kMaxSpeechBytes;
static_assert(kMostBytes <= 0xFFFF);
inline constexpr std::int32_t kMostTime_ms = 3'600'000;

enum class Type : std::uint8_t {
  hello = 1,
  pcm,
  phone,
  word,
  mark,
  sentence,
  end,
  refused,
  say = 16,
  cancel,
};

struct Record {
  Type type = Type::end;
  std::uint32_t utterance = 0;
  std::span<const std::byte> payload;  // Valid until the next call of the reader.

  // The payload's number of 4 or 2 bytes at `offset`; the payload is long enough by then.
  std::uint32_t u32(std::size_t offset) const;
  std::uint16_t u16(std::size_t offset) const;
  std::int32_t time_ms() const { return static_cast<std::int32_t>(u32(0)); }
  // What follows the first `offset` bytes, as text.
  std::span<const char> text(std::size_t offset) const;
};

// Why bytes are refused (Status::detail of corrupt_data).
enum class Refusal : std::uint16_t { none, unknown_type, reserved_byte, wrong_size, bad_time };

// Cuts a stream of bytes into records and checks each: type, size and time. After a refusal the
// stream is lost for good, since nothing tells where the next record starts.
class Reader {
 public:
  // Where to put new bytes; tell how many by took(). Never empty once next() said not_ready.
  std::span<std::byte> room();
  void took(std::size_t bytes) { filled_ += bytes; }

  // The next whole record. not_ready: more bytes are needed. corrupt_data: see Refusal.
  Status next(Record* out);
  void reset() { *this = Reader{}; }

 private:
  std::array<std::byte, 2 * (kHeadBytes + kMostBytes)> bytes_{};
  std::size_t begin_ = 0, filled_ = 0;
};

// Writes the head of a record into 8 bytes.
void put_head(Type type, std::uint32_t utterance, std::size_t payload_bytes,
              std::span<std::byte, kHeadBytes> out);
void put_u32(std::uint32_t value, std::byte* out);
void put_u16(std::uint16_t value, std::byte* out);

}  // namespace caryatid::platform::wire
