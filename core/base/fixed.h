#pragma once
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace caryatid {

// A vector of at most N elements, stored in place. push() says whether there was room.
template <class T, std::size_t N>
class FixedVector {
 public:
  [[nodiscard]] bool push(const T& value) {
    if (size_ == N) return false;
    items_[size_++] = value;
    return true;
  }
  void pop() {
    assert(size_ > 0);
    --size_;
  }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  static constexpr std::size_t capacity() { return N; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t index) {
    assert(index < size_);
    return items_[index];
  }
  const T& operator[](std::size_t index) const {
    assert(index < size_);
    return items_[index];
  }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }
  std::span<T> span() { return {items_.data(), size_}; }
  std::span<const T> span() const { return {items_.data(), size_}; }

 private:
  std::array<T, N> items_{};
  std::size_t size_ = 0;
};

// N flags. Index out of range asserts.
template <std::size_t N>
class BitSet {
 public:
  constexpr bool test(std::size_t index) const {
    assert(index < N);
    return (words_[index / 64] >> (index % 64)) & 1u;
  }
  constexpr void set(std::size_t index, bool on = true) {
    assert(index < N);
    const std::uint64_t bit = std::uint64_t{1} << (index % 64);
    words_[index / 64] = on ? words_[index / 64] | bit : words_[index / 64] & ~bit;
  }
  constexpr void clear() { words_ = {}; }
  constexpr bool any() const {
    for (const std::uint64_t w : words_)
      if (w != 0) return true;
    return false;
  }
  constexpr std::size_t count() const {
    std::size_t n = 0;
    for (const std::uint64_t w : words_) n += static_cast<std::size_t>(std::popcount(w));
    return n;
  }
  friend constexpr bool operator==(const BitSet&, const BitSet&) = default;

 private:
  std::array<std::uint64_t, (N + 63) / 64> words_{};
};

// Text of at most N bytes, always zero-terminated; longer text is cut at N.
template <std::size_t N>
class FixedString {
 public:
  FixedString() = default;
  explicit FixedString(std::span<const char> text) { assign(text); }
  void assign(std::span<const char> text) {
    size_ = text.size() < N ? text.size() : N;
    if (size_ > 0) std::memcpy(text_.data(), text.data(), size_);
    text_[size_] = '\0';
  }
  const char* c_str() const { return text_.data(); }
  std::size_t size() const { return size_; }
  std::span<const char> span() const { return {text_.data(), size_}; }

 private:
  std::array<char, N + 1> text_{};
  std::size_t size_ = 0;
};

}  // namespace caryatid
