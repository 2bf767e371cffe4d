#pragma once
// A priority queue of vertices by the cost of their cheapest edge: a heap of four children, whose
// keys are cost and vertex in one word (costs are not negative, so their bits are in their order),
// with places, so that a key changes in O(log n) and nothing stale stays behind. 12 bytes a vertex.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace caryatid::bake {

class VertexQueue {
 public:
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  explicit VertexQueue(std::uint32_t count) : heap_(count), place_(count) {
    for (std::uint32_t v = 0; v < count; ++v) fill(v, kNever);
  }
  // The first keys, each >= 0; then start().
  void fill(std::uint32_t vertex, float key) {
    heap_[vertex] = entry(key, vertex);
    place_[vertex] = vertex;
  }
  void start() {
    for (auto i = static_cast<std::uint32_t>(heap_.size()); i-- > 0;) sink(i, heap_[i]);
  }
  bool empty() const { return heap_.empty() || key_of(heap_[0]) == kNever; }
  std::uint32_t top() const { return static_cast<std::uint32_t>(heap_[0]); }
  float key(std::uint32_t vertex) const { return key_of(heap_[place_[vertex]]); }
  void set(std::uint32_t vertex, float key) {
    const std::uint32_t at = place_[vertex];
    const std::uint64_t e = entry(key, vertex);
    if (e < heap_[at])
      rise(at, e);
    else if (e > heap_[at])
      sink(at, e);
  }

 private:
  static std::uint64_t entry(float key, std::uint32_t vertex) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(key)} << 32 | vertex;
  }
  static float key_of(std::uint64_t e) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(e >> 32));
  }
  void put(std::uint32_t at, std::uint64_t e) {
    heap_[at] = e;
    place_[static_cast<std::uint32_t>(e)] = at;
  }
  void rise(std::uint32_t at, std::uint64_t e) {
    while (at > 0 && e < heap_[(at - 1) / 4]) {
      put(at, heap_[(at - 1) / 4]);
      at = (at - 1) / 4;
    }
    put(at, e);
  }
  void sink(std::uint32_t at, std::uint64_t e) {
    const auto size = static_cast<std::uint32_t>(heap_.size());
    for (std::uint32_t first; (first = 4 * at + 1) < size;) {
      std::uint32_t least = first;
      const std::uint32_t end = std::min(first + 4, size);
      for (std::uint32_t child = first + 1; child < end; ++child)
        if (heap_[child] < heap_[least]) least = child;
      if (heap_[least] >= e) break;
      put(at, heap_[least]);
      at = least;
    }
    put(at, e);
  }

  std::vector<std::uint64_t> heap_;
  std::vector<std::uint32_t> place_;
};

}  // namespace caryatid::bake
