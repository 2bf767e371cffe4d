#pragma once
// Reading and writing single bits, most significant first, as MPEG-4 streams count them.
#include <cstddef>
#include <cstdint>
#include <span>

namespace caryatid::stream {

// Reads from borrowed bytes. Past the end every bit is 0 and ran_over() says so: a caller decodes a
// whole unit first and asks once.
class BitReader {
 public:
  BitReader() = default;
  BitReader(std::span<const std::byte> bytes, std::size_t position_bits)
      : bytes_(bytes), position_(position_bits), furthest_(position_bits) {}

  std::uint32_t bit() {
    const std::size_t byte = position_ / 8;
    const std::uint32_t value =
        byte < bytes_.size()
            ? (static_cast<std::uint32_t>(bytes_[byte]) >> (7 - position_ % 8)) & 1u
            : 0u;
    if (++position_ > furthest_) furthest_ = position_;
    return value;
  }
  // `count` 0..32.
  std::uint32_t bits(int count) {
    std::uint32_t value = 0;
    for (; count > 0; --count) value = value << 1 | bit();
    return value;
  }
  std::size_t position() const { return position_; }
  void seek(std::size_t position_bits) { position_ = position_bits; }
  std::size_t size() const { return bytes_.size() * 8; }
  // Some bit behind the end has been read, even if the position went back since.
  bool ran_over() const { return furthest_ > size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  std::size_t furthest_ = 0;
};

// Appends to a borrowed buffer. Behind its end bits are counted and dropped, so that a size can be
// measured without storage.
class BitWriter {
 public:
  explicit BitWriter(std::span<std::byte> bytes = {}) : bytes_(bytes) {}

  void bit(std::uint32_t value) {
    const std::size_t byte = position_ / 8;
    if (byte < bytes_.size()) {
      const std::uint32_t shift = 7 - static_cast<std::uint32_t>(position_ % 8);
      const auto old = shift == 7 ? 0u : static_cast<std::uint32_t>(bytes_[byte]);
      bytes_[byte] = static_cast<std::byte>(old | (value & 1u) << shift);
    }
    ++position_;
  }
  void bits(std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) bit(value >> i);
  }
  std::size_t position() const { return position_; }
  void seek(std::size_t position_bits) { position_ = position_bits; }
  std::size_t size_bytes() const { return (position_ + 7) / 8; }
  bool fits() const { return position_ <= bytes_.size() * 8; }

 private:
  std::span<std::byte> bytes_;
  std::size_t position_ = 0;
};

}  // namespace caryatid::stream
