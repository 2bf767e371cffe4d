#pragma once
// A priority queue of vertices by the cost of their cheapest edge; binary heap with places, so that
// a key changes in O(log n) and nothing stale stays behind. 12 bytes a vertex.
#include <cstdint>
#include <limits>
#include <vector>

namespace caryatid::bake {

class VertexQueue {
 public:
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  // All of `keys`, vertex by vertex.
  explicit VertexQueue(const std::vector<float>& keys) : place_(keys.size()) {
    heap_.reserve(keys.size());
    for (std::uint32_t v = 0; v < keys.size(); ++v) heap_.push_back({keys[v], v});
    for (std::uint32_t i = 0; i < heap_.size(); ++i) place_[heap_[i].vertex] = i;
    for (auto i = static_cast<std::uint32_t>(heap_.size() / 2); i-- > 0;) sink(i, heap_[i]);
  }
  bool empty() const { return heap_.empty() || heap_[0].key == kNever; }
  std::uint32_t top() const { return heap_[0].vertex; }
  float key(std::uint32_t vertex) const { return heap_[place_[vertex]].key; }
  void set(std::uint32_t vertex, float key) {
    const std::uint32_t at = place_[vertex];
    const Entry entry{key, vertex};
    if (before(entry, heap_[at]))
      rise(at, entry);
    else
      sink(at, entry);
  }

 private:
  struct Entry {
    float key;
    std::uint32_t vertex;
  };
  static bool before(const Entry& a, const Entry& b) {
    return a.key < b.key || (a.key == b.key && a.vertex < b.vertex);
  }
  void put(std::uint32_t at, const Entry& entry) {
    heap_[at] = entry;
    place_[entry.vertex] = at;
  }
  void rise(std::uint32_t at, const Entry& entry) {
    while (at > 0 && before(entry, heap_[(at - 1) / 2])) {
      put(at, heap_[(at - 1) / 2]);
      at = (at - 1) / 2;
    }
    put(at, entry);
  }
  void sink(std::uint32_t at, Entry entry) {
    const auto size = static_cast<std::uint32_t>(heap_.size());
    for (std::uint32_t child; (child = 2 * at + 1) < size; at = child) {
      if (child + 1 < size && before(heap_[child + 1], heap_[child])) ++child;
      if (!before(heap_[child], entry)) break;
      put(at, heap_[child]);
    }
    put(at, entry);
  }

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;
};

}  // namespace caryatid::bake
