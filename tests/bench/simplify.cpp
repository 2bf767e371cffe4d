// Simplification beside its peers: error, time and memory at five levels of each mesh, and how time
// grows up to half a million triangles. Meshes of others need CARYATID_TEST_DATA.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <set>

#include "assets/bake/human/build.h"
#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/mesh_io/repair.h"
#include "assets/bake/simplify/distance.h"
#include "assets/bake/simplify/object_history.h"
#include "assets/bake/simplify/symmetry.h"
#include "core/base/crc.h"
#include "tests/bench/bench.h"
#include "tests/bench/simplify_peers.h"
#include "tests/unit/bake/simplify/shapes.h"

namespace caryatid::bench {
namespace {

using bake::Surface;

// Made when first asked for: other benchmarks should not wait for it.
struct LazySurface {
  std::function<Surface()> make;
  Surface surface;
  const Surface& get() {
    if (surface.triangles.empty()) surface = make();
    return surface;
  }
};

struct Case {
  std::string mesh;
  LazySurface* lazy = nullptr;
  std::size_t peer = 0;
  double level = 1;  // Share of the faces.
};
struct Row {
  Case what;
  std::size_t faces = 0;
  double seconds = 1e9, peak_bytes = 0, volume_change = 0;
  bake::SurfaceError error;
  bool measured = false;
};
std::map<std::string, Row>& rows() {
  static std::map<std::string, Row> list;
  return list;
}

std::uint64_t hash_surface(const Surface& s) {
  return hash_of(std::span<const bake::Triangle>(s.triangles),
                 hash_of(std::span<const bake::Vec3d>(s.position)));
}

void simplify(benchmark::State& state, const Case& c, bool measure) {
  const Surface& original = c.lazy->get();
  const auto target = static_cast<std::uint32_t>(
      std::lround(c.level * static_cast<double>(original.triangles.size())));
  PeerRun run;
  Row row;
  row.what = c;
  for ([[maybe_unused]] auto _ : state) {
    run = peers()[c.peer].run(original, target);
    state.SetIterationTime(run.seconds);
    row.seconds = std::min(row.seconds, run.seconds);
  }
  const bake::SurfaceFacts facts = bake::facts_of(original);
  row.faces = run.result.triangles.size();
  row.peak_bytes = run.peak_bytes;
  row.volume_change = bake::facts_of(run.result).volume / facts.volume - 1;
  row.measured = measure;
  if (measure) row.error = bake::measure_error(original, run.result);
  state.counters["faces"] = static_cast<double>(row.faces);
  state.counters["bytes_per_face"] =
      run.peak_bytes / static_cast<double>(original.triangles.size());
  state.counters["volume_change"] = row.volume_change;
  state.counters["mean"] = row.error.mean() / facts.diagonal;
  state.counters["rms"] = row.error.rms() / facts.diagonal;
  state.counters["hausdorff"] = row.error.hausdorff() / facts.diagonal;
  state.SetLabel(label_of(hash_surface(run.result)));
  rows()[c.mesh + "/" + std::to_string(1000 - static_cast<int>(1000 * c.level)) + "/" +
         std::to_string(c.peer)] = row;
}

void print_table() {
  if (rows().empty()) return;
  std::printf("\n%-16s %6s %-22s %8s %9s %8s %8s %8s %8s %9s\n", "mesh", "level", "method", "faces",
              "ms", "B/face", "mean*", "rms*", "max*", "dvolume");
  for (const auto& [key, r] : rows()) {
    const double d = bake::facts_of(r.what.lazy->get()).diagonal / 1e4;
    std::printf("%-16s %5.0f%% %-22s %8zu %9.2f %8.1f %8.3f %8.3f %8.2f %9.1e\n",
                r.what.mesh.c_str(), 100 * r.what.level, peers()[r.what.peer].name, r.faces,
                1e3 * r.seconds,
                r.peak_bytes / static_cast<double>(r.what.lazy->get().triangles.size()),
                r.error.mean() / d, r.error.rms() / d, r.error.hausdorff() / d, r.volume_change);
  }
  std::puts("* in 1/10000 of the bounding box, both directions, 10 samples a face");
  if (peers().size() < 2) std::puts("no peers: install libcgal-dev and libmeshoptimizer-dev");
}

bool first_and_second(const std::string& key, std::string* second) {
  if (key.back() != '0') return false;
  *second = key.substr(0, key.size() - 1) + "1";
  return rows().count(*second) != 0;
}

void print_ratios() {
  struct Sum {
    double worst_mean = 0, worst_rms = 0, log_max = 0, least_speed = 1e9, most_memory = 0;
    int n = 0;
  };
  std::map<std::string, Sum> sums;
  for (const auto& [key, ours] : rows()) {
    std::string other;
    if (!first_and_second(key, &other) || !ours.measured) continue;
    const Row& cgal = rows()[other];
    Sum& s = sums[ours.what.mesh];
    s.worst_mean = std::max(s.worst_mean, ours.error.mean() / cgal.error.mean());
    s.worst_rms = std::max(s.worst_rms, ours.error.rms() / cgal.error.rms());
    s.log_max += std::log(ours.error.hausdorff() / cgal.error.hausdorff());
    s.least_speed = std::min(s.least_speed, cgal.seconds / ours.seconds);
    s.most_memory = std::max(s.most_memory, ours.peak_bytes / cgal.peak_bytes);
    ++s.n;
  }
  for (const auto& [mesh, s] : sums)
    std::printf(
        "%-16s ours / CGAL Lindstrom-Turk: mean <= %.3f, rms <= %.3f, max %.3f (geometric "
        "mean), %.1f times as fast or more, memory <= %.2f\n",
        mesh.c_str(), s.worst_mean, s.worst_rms, std::exp(s.log_max / s.n), s.least_speed,
        s.most_memory);
}

void add_mesh(const std::string& name, std::function<Surface()> make, bool measure,
              const std::vector<double>& levels) {
  static std::map<std::string, LazySurface> surfaces;
  LazySurface* s = &surfaces[name];
  s->make = std::move(make);
  for (std::size_t p = 0; p < peers().size(); ++p)
    for (const double level : levels) {
      const Case c{name, s, p, level};
      benchmark::RegisterBenchmark(
          ("simplify/" + name + "/" + peers()[p].name + "/" +
           std::to_string(static_cast<int>(100 * level)))
              .c_str(),
          [c, measure](benchmark::State& state) { simplify(state, c, measure); })
          ->UseManualTime()
          ->Iterations(measure ? 3 : 1)
          ->Unit(benchmark::kMillisecond);
    }
}

// The skin of the whole base human (26756 faces), unmorphed.
Surface body_skin() {
  const bake::BaseHuman base(bake::BaseHuman::default_folder());
  Surface out;
  for (const Vec3& p : base.rest_m()) out.position.emplace_back(p);
  for (const bake::Quad& q : base.quads()) {
    if (q.group != 0) continue;
    out.triangles.push_back({q.vertex[0], q.vertex[1], q.vertex[2]});
    out.triangles.push_back({q.vertex[0], q.vertex[2], q.vertex[3]});
  }
  bake::RepairReport repairs;
  return bake::repair_surface(std::move(out), &repairs);
}

bake::Character woman() {
  const std::string folder = CARYATID_SOURCE_DIR "/assets/characters/";
  const bake::BaseHuman base(bake::BaseHuman::default_folder());
  return bake::build_character(bake::read_recipe(folder + "woman.toml"), base,
                               bake::read_feature_points(folder + "feature_points.toml", base));
}

// The skin of the woman's head (8508 faces), its texture seams closed.
Surface head_skin() {
  const bake::Character character = woman();
  Surface out;
  for (const bake::Object& object : character.objects) {
    if (object.role != pack::ObjectRole::head) continue;
    for (const Vec3& p : object.mesh.position_m) out.position.emplace_back(p);
    out.triangles = object.mesh.triangles;
  }
  bake::RepairReport repairs;
  return bake::repair_surface(std::move(out), &repairs);
}

// The part of an object's mesh that faces +z, or the other.
Surface side_of(const bake::Mesh& mesh, bool front) {
  Surface out;
  for (const Vec3& p : mesh.position_m) out.position.emplace_back(p);
  for (const bake::Triangle& t : mesh.triangles) {
    const float z = mesh.normal[t[0]].z + mesh.normal[t[1]].z + mesh.normal[t[2]].z;
    if ((z > -0.35f) == front) out.triangles.push_back(t);
  }
  return out;
}

// Millimetres, rms over each side of the original, at the coarsest level of `h`.
void measure_sides(const bake::Mesh& mesh, const bake::ObjectHistory& h, const std::string& name,
                   benchmark::State& state) {
  Surface level;
  for (std::uint32_t v = 0; v < h.base_vertex_count; ++v)
    level.position.emplace_back(h.versions[v].position_m);
  level.triangles = h.base_triangles;
  const bake::SurfaceTree tree(level);
  state.counters[name + "_front_mm"] = 1e3 * bake::one_sided(side_of(mesh, true), tree, 10, 1).rms;
  state.counters[name + "_behind_mm"] =
      1e3 * bake::one_sided(side_of(mesh, false), tree, 10, 1).rms;
}

// What importance by region gains: the head at N faces with all alike, and with what is seen from
// the front counting more.
void importance(benchmark::State& state) {
  const bake::Character character = woman();
  std::uint32_t o = 0;
  while (character.objects[o].role != pack::ObjectRole::head) ++o;
  bake::Object head = character.objects[o];  // With the locks that the bake gives it.
  for (const bake::FeaturePoint& p : character.feature_points)
    if (p.object == o) head.locked.push_back(p.vertex);
  bake::ObjectOptions options;
  options.base_triangles = static_cast<std::uint32_t>(state.range(0));
  options.pose_weight = 10.0;
  measure_sides(head.mesh, bake::simplify_object(head, options), "even", state);
  options.importance = bake::importance_of_head(character, o);
  bake::ObjectHistory weighted;
  for ([[maybe_unused]] auto _ : state) weighted = bake::simplify_object(head, options);
  measure_sides(head.mesh, weighted, "weighted", state);
}

bool register_all() {
  const std::vector<double> levels = {0.5, 0.25, 0.12, 0.06, 0.03};
  add_mesh(
      "ball_20k", [] { return bake::ball(72, 0.15); }, true, levels);
  if (!bake::BaseHuman::missing(bake::BaseHuman::default_folder())) {
    add_mesh("head_skin", head_skin, true, levels);
    add_mesh("body_skin", body_skin, true, levels);
    benchmark::RegisterBenchmark("simplify/importance", importance)
        ->Arg(2141)
        ->Arg(1307)
        ->Arg(680)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
  if (const char* data = std::getenv("CARYATID_TEST_DATA"); data != nullptr)
    for (const char* name : {"spot", "teapot", "stanford-bunny"}) {
      const std::filesystem::path path =
          std::filesystem::path(data) / "meshes" / (std::string(name) + ".obj");
      if (!std::filesystem::exists(path)) continue;
      const auto read = [path] {
        bake::RepairReport repairs;
        return bake::repair_surface(bake::read_mesh(path), &repairs);
      };
      add_mesh(name, read, true, levels);
    }
  for (const std::uint32_t rows : {89u, 177u, 354u})  // 31k, 124k, 500k triangles.
    add_mesh("growth_" + std::to_string(4 * rows * (rows - 1) / 1000) + "k",
             [rows] { return bake::ball(rows, 0.1); }, false, {0.03});
  at_end(print_table);
  return at_end(print_ratios);
}

const bool registered = register_all();

}  // namespace
}  // namespace caryatid::bench
