#pragma once
// The live mesh of one object: any level of detail between its base mesh and full resolution,
// reached by applying or undoing the split records of the pack. After Hoppe 1996, with the records
// of Lindstrom-Turk collapses (thesis chapter 2, ../pack/pack.h for their layout).
//
// Slots [0, vertex_count) and triangles [0, triangle_count) are live, so a level is drawn from
// prefixes of fixed buffers. Slots below base_vertex_count never disappear: locked vertices
// (feature points) keep one slot for ever. Every slot shows one *version* of a vertex (an index
// into MeshSource::versions); tables that hang on versions (the FAT) need nothing else.
//
// A level is a function of the number of triangles alone: up and down again gives the same bits.
#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "core/base/status.h"
#include "core/mesh/vertex.h"
#include "core/pack/pack.h"

namespace caryatid::mesh {

// The part of a pack that one object needs. Borrowed; must outlive the mesh.
struct MeshSource {
  std::span<const pack::Vertex> versions;       // Of this object only.
  std::span<const std::uint16_t> base_indices;  // 3 * base triangles
  std::span<const pack::Split> splits;          // Of this object only, coarse to fine.
  std::span<const std::uint16_t> split_data;    // The whole section: Split::data counts from its 0.
  std::uint32_t base_vertex_count = 0;
  std::uint32_t max_vertex_count = 0;  // At full resolution.
  std::uint32_t max_triangle_count = 0;
};

inline constexpr std::uint16_t kNoVersion = 0xFFFF;

enum class MeshFault : std::uint16_t {
  none,
  too_many_vertices,  // Slots, versions and triangles are 16-bit; maxima must cover the base.
  base_index_range,   // A base triangle names a slot beyond the base vertices.
  counts,             // Counts of a record are not those of split or reorder.
  words_range,        // The words of a record reach past split_data.
  version_range,      // A record names a version that the object lacks.
  slot_range,         // A record names a slot that is not live when it is applied.
  triangle_range,     // A record names a triangle that is not live when it is applied.
  capacity,           // More live vertices or triangles than the object promised.
  not_a_permutation,  // A reorder record names a triangle twice.
};

// Checks records [first, last) of bytes from outside so that LiveMesh can trust them. Call with the
// counters of the base mesh first, then chunk by chunk as the file loads. O(words), no allocation.
struct SplitChecker {
  std::uint32_t vertex_count = 0, triangle_count = 0;

  // Base mesh. corrupt_data with a MeshFault.
  Status start(const MeshSource& source);
  // `scratch` is max_triangle_count long (marks of a permutation).
  Status check(const MeshSource& source, std::uint32_t first, std::uint32_t last,
               std::span<std::uint16_t> scratch);
};

class LiveMesh {
 public:
  // Bytes that start() takes from the arena at most, alignment included.
  static std::uint32_t arena_bytes(const MeshSource& source);

  // Takes its buffers and shows the base mesh. `index_scratch` serves reorder records, is shared by
  // all meshes, and holds 3 * max_triangle_count words of the largest.
  // out_of_capacity: the arena or index_scratch is too small.
  Status start(const MeshSource& source, Arena& arena, std::span<std::uint16_t> index_scratch);

  // Splits that have arrived and been checked; grows while the file loads. Starts at 0.
  void set_available(std::uint32_t split_count) { available_ = split_count; }
  std::uint32_t available() const { return available_; }
  // Splits applied; its change over a frame is the records that the frame paid for.
  std::uint32_t applied() const { return cursor_; }

  // Shows the finest level of at most `triangles` (the base mesh if that is already more). Ends a
  // geomorph at once. O(records that differ), about 0.1 us each on a PC; a reorder record among
  // them costs O(live triangles).
  void set_level(std::uint32_t triangles);

  // The same by geomorph: from now on weight() says how far slots that differ have moved, and the
  // connectivity of the finer of both levels is on show. A geomorph that was under way ends first.
  // duration_s 0.2-0.5 is usual; 0 is set_level.
  void morph_to_level(std::uint32_t triangles, float duration_s);
  // Advances the geomorph and rewrites the vertices in it. Nothing happens without one.
  void advance(float dt_s);
  bool morphing() const { return morph_count_ > 0; }

  std::uint32_t vertex_count() const { return vertex_count_; }
  std::uint32_t triangle_count() const { return triangle_count_; }
  // Triangles of the level that is on show or being morphed to.
  std::uint32_t target_triangle_count() const {
    return morphing() && coarsening_ ? target_triangles_ : triangle_count_;
  }

  // Live buffers; whole capacity, a prefix is in use. The deformer writes into dynamic().
  std::span<DynamicVertex> dynamic() { return dynamic_; }
  std::span<const DynamicVertex> dynamic() const { return dynamic_; }
  std::span<const StaticVertex> fixed() const { return fixed_; }
  std::span<const std::uint16_t> indices() const { return indices_; }

  // Version that a slot shows, and the one that it is blended with (kNoVersion outside a morph):
  //   shown = (1 - morph_weight()) * version + morph_weight() * morph_version
  std::span<const std::uint16_t> version() const { return version_.first(vertex_count_); }
  std::span<const std::uint16_t> morph_version() const { return other_.first(vertex_count_); }
  float morph_weight() const { return weight_; }
  // Undeformed vertex of a slot, geomorph included. A deformer starts from it.
  DynamicVertex rest(std::uint32_t slot) const;

  // What set_level, morph_to_level and advance wrote since the last clear_dirty().
  DirtyRange dirty_dynamic() const { return dirty_dynamic_.clipped(vertex_count_); }
  DirtyRange dirty_fixed() const { return dirty_fixed_.clipped(vertex_count_); }
  DirtyRange dirty_indices() const { return dirty_indices_.clipped(3 * triangle_count_); }
  void clear_dirty() { dirty_dynamic_ = dirty_fixed_ = dirty_indices_ = {}; }

 private:
  void apply(const pack::Split& split);
  void undo(const pack::Split& split);
  void reorder(const pack::Split& split, bool forward);
  void show(std::uint32_t slot);  // Writes a slot's vertex into the live buffers.
  void put_version(std::uint32_t slot, std::uint16_t version);
  std::uint32_t cursor_for(std::uint32_t triangles) const;
  void move_cursor(std::uint32_t cursor);
  void pair_versions(std::uint32_t coarse, std::uint32_t fine);
  void add_to_morph(std::uint32_t slot, std::uint16_t version);
  void show_morph();
  void end_morph();

  MeshSource source_;
  std::span<DynamicVertex> dynamic_;
  std::span<StaticVertex> fixed_;
  std::span<std::uint16_t> indices_, index_scratch_;
  std::span<std::uint16_t> version_, other_;  // By slot.
  std::span<std::uint16_t> morph_slots_;      // First morph_count_ are slots in the geomorph.
  std::uint32_t vertex_count_ = 0, triangle_count_ = 0;
  std::uint32_t cursor_ = 0, available_ = 0;  // Splits applied, splits that may be.
  std::uint32_t morph_count_ = 0, coarse_cursor_ = 0, target_triangles_ = 0;
  bool coarsening_ = false;
  float weight_ = 0.0f, weight_per_s_ = 0.0f;
  DirtyRange dirty_dynamic_, dirty_fixed_, dirty_indices_;
};

}  // namespace caryatid::mesh
