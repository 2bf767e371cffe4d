#pragma once
// What the simplification of one object leaves behind: every version of every vertex, the coarsest
// mesh, and the records that lead from there to full resolution. The pack writer stores just this.
#include <array>
#include <cstdint>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake {

// One version of a vertex with all that hangs on it.
struct VertexVersion {
  Vec3 position_m{0};
  Vec3 normal{0};
  Vec2 uv{0};
  float occlusion = 0.0f;  // See Mesh::occlusion.
  Influence influence;
  struct ChannelMove {
    std::uint16_t channel = 0;
    Vec3 displacement_m{0};
    Vec3 normal_change{0};
  };
  std::vector<ChannelMove> moves;  // Channels ascending.
};

// One collapse seen from the coarse side; the fields of pack::Split, see there.
struct SplitRecord {
  struct Change {
    std::uint32_t slot = 0, version_before = 0, version_after = 0;
  };
  struct Addition {
    std::uint32_t parent = 0, version = 0;  // The slot itself follows from the order.
  };
  std::vector<Change> changed;
  std::vector<Addition> added;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> moved;
  double cost = 0;                       // Of the collapse, volume^2 (f_C of thesis 3-8).
  std::vector<std::uint32_t> reordered;  // Not empty: a reorder record instead, see pack::Split.
};

struct ObjectHistory {
  std::vector<VertexVersion> versions;  // Base slots first, then as the splits use them.
  std::vector<std::array<std::uint32_t, 3>> base_triangles;
  std::uint32_t base_vertex_count = 0;
  std::vector<SplitRecord> splits;  // Coarse to fine.
  std::uint32_t max_vertex_count = 0;
  std::uint32_t max_triangle_count = 0;
  // Slot of each vertex of the full mesh at full resolution. Locked vertices: their slot at every
  // level, below base_vertex_count.
  std::vector<std::uint32_t> slot_of_vertex;
};

struct ObjectOptions {
  std::uint32_t base_triangles = 0;  // Stop here, or when nothing more may collapse.
  // Weight of the volume error of each animation pose beside that of rest: mouth and eyes resist.
  double pose_weight = 0.5;
  bool vertex_cache_order = true;
  // Edges of a mesh that is symmetric about x = 0 collapse in pairs, so that every level is, too.
  bool symmetric_pairs = true;
  // By vertex, or empty: the cost of an edge is multiplied by what its ends count (their geometric
  // mean). Where the object is seldom seen, less.
  std::vector<float> importance = {};
};

// Simplifies an object as far as its locks allow; the finest level is the object itself, bit for
// bit. Rules for seams, locks and loops: object_collapse.cpp. Deterministic. O(n log n).
// channel_count: of the character; moves of the object are indexed by it.
// Throws std::runtime_error when the mesh breaks its contract (index out of range, lengths).
ObjectHistory simplify_object(const Object& object, const ObjectOptions& options);

// Inserts reorder records wherever the mesh has grown by a quarter, so that at every level at most
// a fifth of the triangles stand outside the order of cache_order.h.
void add_reorders(ObjectHistory* history);

}  // namespace caryatid::bake
