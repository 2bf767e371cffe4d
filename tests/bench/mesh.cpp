// Levels of detail on the board: what a split costs up and down, beside a full rebuild of the index
// buffer, and how the vertex cache fares at each level.
#include <memory>
#include <vector>

#include "assets/bake/pack/quantise.h"
#include "assets/bake/simplify/cache_order.h"
#include "assets/bake/simplify/object_history.h"
#include "core/base/crc.h"
#include "core/mesh/progressive.h"
#include "core/mesh/split.h"
#include "tests/bench/bench.h"
#include "tests/unit/bake/simplify/shapes.h"

namespace caryatid::bench {
namespace {

// A wavy ball of 9800 triangles, about the skin of a head, with all that its splits need.
struct Detail {
  std::vector<pack::Vertex> versions;
  std::vector<std::uint16_t> base, words;
  std::vector<pack::Split> splits;
  mesh::MeshSource source;
  std::vector<std::byte> memory;
  std::vector<std::uint16_t> scratch;
  std::unique_ptr<Arena> arena;
  mesh::LiveMesh live;

  explicit Detail(bool reorder) {
    bake::Object object;
    const bake::Surface surface = bake::ball(50, 0.15);
    for (const bake::Vec3d& p : surface.position) {
      object.mesh.position_m.push_back(0.1f * Vec3(p));
      object.mesh.normal.push_back(glm::normalize(Vec3(p)));
      object.mesh.uv.push_back({0.5f, 0.5f});
      object.mesh.influence.push_back({});
    }
    object.mesh.triangles = surface.triangles;
    bake::ObjectOptions options;
    options.base_triangles = 600;
    options.vertex_cache_order = reorder;
    fill(bake::simplify_object(object, options));
    memory.resize(mesh::LiveMesh::arena_bytes(source));
    scratch.resize(std::size_t{3} * source.max_triangle_count);
    arena = std::make_unique<Arena>(memory);
    if (!live.start(source, *arena, scratch).ok()) std::abort();
    live.set_available(static_cast<std::uint32_t>(splits.size()));
  }

  void fill(const bake::ObjectHistory& h) {
    const std::uint16_t palette[1] = {0};
    for (const bake::VertexVersion& v : h.versions) versions.push_back(quantise(v, palette));
    for (const auto& t : h.base_triangles)
      for (const std::uint32_t slot : t) word(&base, slot);
    std::uint32_t version = h.base_vertex_count;
    for (const bake::SplitRecord& r : h.splits) {
      pack::Split s{};
      s.data = static_cast<std::uint32_t>(words.size());
      s.first_version = static_cast<std::uint16_t>(version);
      s.flags = r.reordered.empty() ? 0 : pack::kReorder;
      if (!r.reordered.empty()) word(&words, r.reordered.size());
      for (const std::uint32_t t : r.reordered) word(&words, t);
      s.moved_count = static_cast<std::uint16_t>(r.moved.size());
      s.changed_count = static_cast<std::uint8_t>(r.changed.size());
      s.added_vertices = static_cast<std::uint8_t>(r.added.size());
      s.added_triangles = static_cast<std::uint8_t>(r.triangles.size());
      for (const auto& c : r.changed) {
        word(&words, c.slot);
        word(&words, c.version_before);
      }
      for (const auto& a : r.added) word(&words, a.parent);
      for (const auto& t : r.triangles)
        for (const std::uint32_t slot : t) word(&words, slot);
      for (const std::uint32_t t : r.moved) word(&words, t);
      version += s.changed_count + s.added_vertices;
      splits.push_back(s);
    }
    source = {versions,
              base,
              splits,
              words,
              h.base_vertex_count,
              h.max_vertex_count,
              h.max_triangle_count};
  }
  static void word(std::vector<std::uint16_t>* out, std::size_t value) {
    out->push_back(static_cast<std::uint16_t>(value));
  }
};

std::uint64_t hash_of_level(const mesh::LiveMesh& m) {
  return hash_of(m.dynamic().first(m.vertex_count()),
                 hash_of(m.indices().first(std::size_t{3} * m.triangle_count())));
}

// Down to `low` percent and up again.
void switch_levels(benchmark::State& state) {
  Detail detail(state.range(1) != 0);
  const std::uint32_t full = detail.source.max_triangle_count;
  const auto low =
      static_cast<std::uint32_t>(full * static_cast<std::uint32_t>(state.range(0)) / 100);
  detail.live.set_level(full);
  const std::uint32_t vertices = detail.live.vertex_count();
  for ([[maybe_unused]] auto _ : state) {
    detail.live.set_level(low);
    detail.live.set_level(full);
    benchmark::DoNotOptimize(detail.live.indices().data());
  }
  detail.live.set_level(low);
  const double records = 2.0 * (vertices - detail.live.vertex_count());
  state.counters["records"] = records;
  state.counters["per_record"] = benchmark::Counter(
      records, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  bake::TriangleList triangles;
  const auto indices = detail.live.indices();
  for (std::size_t t = 0; t < detail.live.triangle_count(); ++t)
    triangles.push_back({indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]});
  state.counters["cache_misses_per_triangle"] = bake::misses_per_triangle(triangles);
  state.SetLabel(label_of(hash_of_level(detail.live)));
}
BENCHMARK(switch_levels)
    ->Name("mesh/switch_levels")
    ->ArgNames({"low_percent", "reorder"})
    ->ArgsProduct({{95, 80, 50, 25, 10}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

// What a level costs without records: every triangle of the full mesh is taken through the chain of
// parents of its slots, and kept if three are left.
void rebuild_index(benchmark::State& state) {
  Detail detail(false);
  detail.live.set_level(detail.source.max_triangle_count);
  std::vector<std::uint16_t> parent(detail.source.max_vertex_count);
  std::uint32_t slot = detail.source.base_vertex_count;
  for (const pack::Split& s : detail.splits)
    for (const std::uint16_t p : mesh::words_of(s, detail.words).parents) parent[slot++] = p;
  const auto limit = static_cast<std::uint16_t>(detail.source.max_vertex_count * 8 / 10);
  const auto indices = detail.live.indices().first(std::size_t{3} * detail.live.triangle_count());
  std::vector<std::uint16_t> out(indices.size());
  std::size_t n = 0;
  for ([[maybe_unused]] auto _ : state) {
    n = 0;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint16_t v = indices[t + i];
        while (v >= limit) v = parent[v];
        out[n + i] = v;
      }
      if (out[n] != out[n + 1] && out[n + 1] != out[n + 2] && out[n + 2] != out[n]) n += 3;
    }
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["triangles"] = static_cast<double>(n / 3);
  state.SetLabel(label_of(hash_of(std::span<const std::uint16_t>(out).first(n))));
}
BENCHMARK(rebuild_index)->Name("mesh/rebuild_index")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace caryatid::bench
