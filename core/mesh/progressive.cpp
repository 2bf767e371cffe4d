#include "core/mesh/progressive.h"

#include <algorithm>
#include <cassert>

#include "core/mesh/split.h"

namespace caryatid::mesh {

std::uint32_t LiveMesh::arena_bytes(const MeshSource& source) {
  const std::size_t per_vertex =
      sizeof(DynamicVertex) + sizeof(StaticVertex) + 3 * sizeof(std::uint16_t);
  constexpr std::size_t kAlignment = 6 * 16;
  return static_cast<std::uint32_t>(source.max_vertex_count * per_vertex +
                                    source.max_triangle_count * 3 * sizeof(std::uint16_t) +
                                    kAlignment);
}

Status LiveMesh::start(const MeshSource& source, Arena& arena,
                       std::span<std::uint16_t> index_scratch) {
  const std::size_t vertices = source.max_vertex_count;
  const std::size_t index_count = std::size_t{3} * source.max_triangle_count;
  *this = {};
  source_ = source;
  index_scratch_ = index_scratch;
  dynamic_ = arena.take<DynamicVertex>(vertices);
  fixed_ = arena.take<StaticVertex>(vertices);
  indices_ = arena.take<std::uint16_t>(index_count);
  version_ = arena.take<std::uint16_t>(vertices);
  other_ = arena.take<std::uint16_t>(vertices);
  morph_slots_ = arena.take<std::uint16_t>(vertices);
  if (dynamic_.size() < vertices || fixed_.size() < vertices || indices_.size() < index_count ||
      version_.size() < vertices || other_.size() < vertices || morph_slots_.size() < vertices ||
      index_scratch.size() < index_count)
    return {Code::out_of_capacity, 0};
  std::copy(source.base_indices.begin(), source.base_indices.end(), indices_.begin());
  std::fill(other_.begin(), other_.end(), kNoVersion);
  vertex_count_ = source.base_vertex_count;
  triangle_count_ = static_cast<std::uint32_t>(source.base_indices.size() / 3);
  dirty_indices_ = {0, 3 * triangle_count_};
  for (std::uint32_t slot = 0; slot < vertex_count_; ++slot)
    put_version(slot, static_cast<std::uint16_t>(slot));
  return {};
}

void LiveMesh::put_version(std::uint32_t slot, std::uint16_t version) {
  const pack::Vertex& v = source_.versions[version];
  version_[slot] = version;
  dynamic_[slot] = {{v.position_m[0], v.position_m[1], v.position_m[2]},
                    {v.normal[0], v.normal[1], v.normal[2], v.normal[3]}};
  fixed_[slot] = {{v.uv[0], v.uv[1]},
                  {v.bone[0], v.bone[1], v.bone[2], v.bone[3]},
                  {v.weight[0], v.weight[1], v.weight[2], v.weight[3]}};
  dirty_dynamic_.add(slot);
  dirty_fixed_.add(slot);
}

void LiveMesh::apply(const pack::Split& split) {
  if (is_reorder(split)) return reorder(split, true);
  const SplitWords w = words_of(split, source_.split_data);
  std::uint16_t version = split.first_version;
  for (std::size_t i = 0; i < w.changed.size(); i += 2) put_version(w.changed[i], version++);
  for (const std::uint16_t t : w.moved)
    for (std::size_t c = 3u * t; c < 3u * t + 3; ++c)
      for (std::size_t p = 0; p < w.parents.size(); ++p)
        if (indices_[c] == w.parents[p]) {
          indices_[c] = static_cast<std::uint16_t>(vertex_count_ + p);
          dirty_indices_.add(static_cast<std::uint32_t>(c));
          break;
        }
  for (std::size_t p = 0; p < w.parents.size(); ++p) put_version(vertex_count_++, version++);
  for (std::size_t i = 0; i < w.triangles.size(); ++i) {
    const std::uint32_t c = 3 * triangle_count_ + static_cast<std::uint32_t>(i);
    indices_[c] = w.triangles[i];
    dirty_indices_.add(c);
  }
  triangle_count_ += split.added_triangles;
}

void LiveMesh::undo(const pack::Split& split) {
  if (is_reorder(split)) return reorder(split, false);
  const SplitWords w = words_of(split, source_.split_data);
  triangle_count_ -= split.added_triangles;
  vertex_count_ -= split.added_vertices;
  for (const std::uint16_t t : w.moved)
    for (std::size_t c = 3u * t; c < 3u * t + 3; ++c)
      if (indices_[c] >= vertex_count_) {  // Only the new slots of this split can be that high.
        indices_[c] = w.parents[indices_[c] - vertex_count_];
        dirty_indices_.add(static_cast<std::uint32_t>(c));
      }
  for (std::size_t i = 0; i < w.changed.size(); i += 2) put_version(w.changed[i], w.changed[i + 1]);
}

void LiveMesh::reorder(const pack::Split& split, bool forward) {
  const std::uint16_t* place = &source_.split_data[split.data + 1];
  const std::span<std::uint16_t> old = index_scratch_.first(3 * triangle_count_);
  std::copy_n(indices_.begin(), old.size(), old.begin());
  for (std::uint32_t t = 0; t < triangle_count_; ++t) {
    const std::size_t from = forward ? place[t] : t, to = forward ? t : place[t];
    std::copy_n(&old[3 * from], 3, &indices_[3 * to]);
  }
  dirty_indices_ = {0, 3 * triangle_count_};
}

// Where the cursor stands for a level: the last record that still keeps within `triangles`.
// Reorder records add none, so the one that follows such a split belongs to its level.
std::uint32_t LiveMesh::cursor_for(std::uint32_t triangles) const {
  std::uint32_t cursor = cursor_;
  std::uint32_t count = triangle_count_;
  while (cursor > 0 && count > triangles) count -= source_.splits[--cursor].added_triangles;
  while (cursor < available_ && count + source_.splits[cursor].added_triangles <= triangles)
    count += source_.splits[cursor++].added_triangles;
  return cursor;
}

void LiveMesh::move_cursor(std::uint32_t cursor) {
  while (cursor_ > cursor) undo(source_.splits[--cursor_]);
  while (cursor_ < cursor) apply(source_.splits[cursor_++]);
}

void LiveMesh::set_level(std::uint32_t triangles) {
  end_morph();
  move_cursor(cursor_for(triangles));
}

}  // namespace caryatid::mesh
