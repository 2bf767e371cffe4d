#pragma once
// The words of one split record, named. Layout in core/pack/pack.h.
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pack/pack.h"

namespace caryatid::mesh {

using Words = std::span<const std::uint16_t>;

struct SplitWords {
  Words changed;    // Pairs: slot, version before.
  Words parents;    // One a new slot.
  Words triangles;  // Three slots a new triangle.
  Words moved;      // Triangles in which one corner goes over from a parent to its new slot.
};

constexpr std::size_t word_count(const pack::Split& split) {
  return 2u * split.changed_count + split.added_vertices + 3u * split.added_triangles +
         split.moved_count;
}

// Valid for checked records only. Not for reorder records.
inline SplitWords words_of(const pack::Split& split, Words data) {
  Words rest = data.subspan(split.data, word_count(split));
  const auto take = [&rest](std::size_t count) {
    const Words head = rest.first(count);
    rest = rest.subspan(count);
    return head;
  };
  SplitWords words;
  words.changed = take(2u * split.changed_count);
  words.parents = take(split.added_vertices);
  words.triangles = take(3u * split.added_triangles);
  words.moved = rest;
  return words;
}

constexpr bool is_reorder(const pack::Split& split) { return (split.flags & pack::kReorder) != 0; }

}  // namespace caryatid::mesh
