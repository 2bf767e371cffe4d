#include "platform/voice/wire.h"

#include <cstring>

namespace caryatid::platform::wire {
namespace {

std::uint32_t number(const std::byte* at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes; i > 0; --i)
    value = value << 8u | std::to_integer<std::uint32_t>(at[i - 1]);
  return value;
}

// Least and most bytes of a payload; false for a type that does not exist.
bool sizes(Type type, std::size_t* least, std::size_t* most) {
  const auto set = [least, most](std::size_t low, std::size_t high) {
    *least = low;
    *most = high;
    return true;
  };
  switch (type) {
    case Type::hello:
      return set(8, 8);
    case Type::pcm:
      return set(2, kMostPcmBytes);
    case Type::phone:
    case Type::mark:
      return set(4, 4 + kMostNameBytes);
    case Type::word:
      return set(12, 12);
    case Type::sentence:
    case Type::end:
      return set(4, 4);
    case Type::refused:
      return set(1, 1);
    case Type::say:
      return set(kSayBytes, kMostBytes);
    case Type::cancel:
      return set(0, 0);
  }
  return false;
}

bool has_time(Type type) {
  return type == Type::phone || type == Type::word || type == Type::mark ||
         type == Type::sentence || type == Type::end;
}

Status refuse(Refusal why) { return {Code::corrupt_data, static_cast<std::uint16_t>(why)}; }

}  // namespace

std::uint32_t Record::u32(std::size_t offset) const { return number(payload.data() + offset, 4); }

std::uint16_t Record::u16(std::size_t offset) const {
  return static_cast<std::uint16_t>(number(payload.data() + offset, 2));
}

std::span<const char> Record::text(std::size_t offset) const {
  return {reinterpret_cast<const char*>(payload.data()) + offset, payload.size() - offset};
}

std::span<std::byte> Reader::room() {
  if (begin_ > 0) {
    std::memmove(bytes_.data(), bytes_.data() + begin_, filled_ - begin_);
    filled_ -= begin_;
    begin_ = 0;
  }
  return std::span(bytes_).subspan(filled_);
}

Status Reader::next(Record* out) {
  if (filled_ - begin_ < kHeadBytes) return {Code::not_ready, 0};
  const std::byte* head = bytes_.data() + begin_;
  const Type type{std::to_integer<std::uint8_t>(head[0])};
  const std::size_t size = number(head + 2, 2);
  std::size_t least = 0, most = 0;
  if (!sizes(type, &least, &most)) return refuse(Refusal::unknown_type);
  if (head[1] != std::byte{0}) return refuse(Refusal::reserved_byte);
  if (size < least || size > most || (type == Type::pcm && size % 2 != 0))
    return refuse(Refusal::wrong_size);
  if (filled_ - begin_ < kHeadBytes + size) return {Code::not_ready, 0};
  *out = {type, number(head + 4, 4), {head + kHeadBytes, size}};
  begin_ += kHeadBytes + size;
  if (has_time(type) && out->u32(0) > std::uint32_t{kMostTime_ms}) return refuse(Refusal::bad_time);
  return {};
}

void put_u32(std::uint32_t value, std::byte* out) {
  for (int i = 0; i < 4; ++i) out[i] = static_cast<std::byte>(value >> (8 * i) & 0xFFu);
}

void put_u16(std::uint16_t value, std::byte* out) {
  for (int i = 0; i < 2; ++i) out[i] = static_cast<std::byte>(value >> (8 * i) & 0xFF);
}

void put_head(Type type, std::uint32_t utterance, std::size_t payload_bytes,
              std::span<std::byte, kHeadBytes> out) {
  out[0] = static_cast<std::byte>(type);
  out[1] = std::byte{0};
  put_u16(static_cast<std::uint16_t>(payload_bytes), &out[2]);
  put_u32(utterance, &out[4]);
}

}  // namespace caryatid::platform::wire
