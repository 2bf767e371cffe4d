#include <algorithm>
#include <utility>

#include "core/mesh/progressive.h"
#include "core/mesh/split.h"

namespace caryatid::mesh {
namespace {

constexpr std::size_t kMaxChanged = 2, kMaxAdded = 2;

Status fault(MeshFault what) { return {Code::corrupt_data, static_cast<std::uint16_t>(what)}; }

bool below(Words words, std::uint32_t limit) {
  return std::all_of(words.begin(), words.end(), [limit](std::uint16_t w) { return w < limit; });
}

Status check_reorder(const MeshSource& source, const pack::Split& split, std::uint32_t triangles,
                     std::span<std::uint16_t> scratch) {
  if ((split.changed_count | split.added_vertices | split.added_triangles | split.moved_count) != 0)
    return fault(MeshFault::counts);
  if (split.data >= source.split_data.size() ||
      source.split_data.size() - split.data - 1 < triangles)
    return fault(MeshFault::words_range);
  if (source.split_data[split.data] != triangles) return fault(MeshFault::counts);
  const Words places = source.split_data.subspan(split.data + 1, triangles);
  if (!below(places, triangles)) return fault(MeshFault::triangle_range);
  if (scratch.size() < triangles) return {Code::out_of_capacity, 0};
  std::fill_n(scratch.begin(), triangles, std::uint16_t{0});
  for (const std::uint16_t place : places)
    if (std::exchange(scratch[place], std::uint16_t{1}) != 0)
      return fault(MeshFault::not_a_permutation);
  return {};
}

Status check_split(const MeshSource& source, const pack::Split& split, std::uint32_t vertices,
                   std::uint32_t triangles) {
  if (split.changed_count > kMaxChanged || split.added_vertices == 0 ||
      split.added_vertices > kMaxAdded || split.added_triangles == 0 ||
      split.added_triangles > kMaxAdded || split.flags != 0)
    return fault(MeshFault::counts);
  const std::size_t words = word_count(split);
  if (split.data > source.split_data.size() || source.split_data.size() - split.data < words)
    return fault(MeshFault::words_range);
  if (std::size_t{split.first_version} + split.changed_count + split.added_vertices >
      source.versions.size())
    return fault(MeshFault::version_range);
  const SplitWords w = words_of(split, source.split_data);
  for (std::size_t i = 0; i < w.changed.size(); i += 2) {
    if (w.changed[i] >= vertices) return fault(MeshFault::slot_range);
    if (w.changed[i + 1] >= source.versions.size()) return fault(MeshFault::version_range);
  }
  if (!below(w.parents, vertices) || !below(w.triangles, vertices + split.added_vertices))
    return fault(MeshFault::slot_range);
  if (!below(w.moved, triangles)) return fault(MeshFault::triangle_range);
  if (vertices + split.added_vertices > source.max_vertex_count ||
      triangles + split.added_triangles > source.max_triangle_count)
    return fault(MeshFault::capacity);
  return {};
}

}  // namespace

Status SplitChecker::start(const MeshSource& source) {
  const std::size_t base_triangles = source.base_indices.size() / 3;
  if (source.max_vertex_count > kNoVersion || source.max_triangle_count > 0xFFFF ||
      source.versions.size() > kNoVersion || source.base_indices.size() % 3 != 0 ||
      source.base_vertex_count > source.versions.size() ||
      source.base_vertex_count > source.max_vertex_count ||
      base_triangles > source.max_triangle_count)
    return fault(MeshFault::too_many_vertices);
  if (!below(source.base_indices, source.base_vertex_count))
    return fault(MeshFault::base_index_range);
  vertex_count = source.base_vertex_count;
  triangle_count = static_cast<std::uint32_t>(base_triangles);
  return {};
}

Status SplitChecker::check(const MeshSource& source, std::uint32_t first, std::uint32_t last,
                           std::span<std::uint16_t> scratch) {
  if (first > last || last > source.splits.size()) return {Code::invalid_argument, 0};
  for (const pack::Split& split : source.splits.subspan(first, last - first)) {
    if (is_reorder(split)) {
      CARYATID_TRY(check_reorder(source, split, triangle_count, scratch));
      continue;
    }
    CARYATID_TRY(check_split(source, split, vertex_count, triangle_count));
    vertex_count += split.added_vertices;
    triangle_count += split.added_triangles;
  }
  return {};
}

}  // namespace caryatid::mesh
