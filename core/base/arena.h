#pragma once
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

namespace caryatid {

// All memory of the agent: one block, taken in pieces at start, then sealed.
// States: open -> sealed. Any take() after seal() asserts; nothing is ever given back.
// Ownership: borrows the block, which must outlive everything taken from it.
// Cost: O(elements constructed). Not thread-safe; used by the start-up thread only.
class Arena {
 public:
  explicit Arena(std::span<std::byte> block) : block_(block) {}
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Value-initialised elements; an empty span when the block is exhausted (check size()).
  template <class T>
  std::span<T> take(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "the arena never runs destructors");
    std::byte* bytes = take_bytes(count, sizeof(T), alignof(T));
    if (bytes == nullptr) return {};
    T* first = reinterpret_cast<T*>(bytes);
    for (std::size_t i = 0; i < count; ++i) new (first + i) T{};
    return {first, count};
  }

  void seal() { sealed_ = true; }
  bool sealed() const { return sealed_; }
  std::size_t used_bytes() const { return used_; }
  std::size_t capacity_bytes() const { return block_.size(); }

 private:
  std::byte* take_bytes(std::size_t count, std::size_t size, std::size_t alignment) {
    assert(!sealed_ && "memory is fixed once the agent runs");
    const auto base = reinterpret_cast<std::uintptr_t>(block_.data());
    const std::size_t start = ((base + used_ + alignment - 1) & ~(alignment - 1)) - base;
    if (start > block_.size() || count > (block_.size() - start) / size) return nullptr;
    used_ = start + count * size;
    return block_.data() + start;
  }

  std::span<std::byte> block_;
  std::size_t used_ = 0;
  bool sealed_ = false;
};

}  // namespace caryatid
