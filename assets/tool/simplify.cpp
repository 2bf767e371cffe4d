// caryatid-tool simplify and history: any mesh, coarser, and back.
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/mesh_io/repair.h"
#include "assets/bake/simplify/distance.h"
#include "assets/bake/simplify/error_bound.h"
#include "assets/bake/simplify/history.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/numbers.h"
#include "assets/tool/progress.h"

namespace caryatid::tool {
namespace {

using bake::MeshError;
using bake::Surface;

struct SimplifyArgs {
  std::string in, out, lock, history, report;
  std::uint32_t faces = 0;
  double max_error = 0;
};

// What of a mesh is not carried over: this tool knows positions and faces.
std::string left_out(const std::string& text, bake::MeshFormat format) {
  if (format != bake::MeshFormat::obj) return {};
  std::size_t uvs = 0, normals = 0;
  for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size()) + 1) {
    uvs += text.compare(at, 3, "vt ") == 0;
    normals += text.compare(at, 3, "vn ") == 0;
  }
  if (uvs + normals == 0) return {};
  return "left out: " + std::to_string(uvs) + " texture coordinates, " + std::to_string(normals) +
         " normals; positions and faces are kept";
}

// A vertex number a line, counted from 1 as in OBJ; '#' comments.
std::vector<std::uint32_t> read_locks(const std::string& path, const bake::RepairReport& repairs) {
  std::vector<std::uint32_t> out;
  const std::string text = bake::read_file(path);
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string word = text.substr(at, end - at);
    at = end + 1;
    ++line;
    word = word.substr(0, word.find('#'));
    if (word.find_first_not_of(" \t\r") == std::string::npos) continue;
    char* rest = nullptr;
    const long long v = std::strtoll(word.c_str(), &rest, 10);
    if (v < 1 || static_cast<std::size_t>(v) > repairs.vertex_of_input.size() ||
        std::string(rest).find_first_not_of(" \t\r") != std::string::npos)
      throw MeshError(path + ":" + std::to_string(line) +
                      ": a lock is the number of a vertex of the mesh, counted from 1");
    const std::uint32_t surface = repairs.vertex_of_input[static_cast<std::size_t>(v - 1)];
    if (surface != bake::kNoHalfEdge) out.push_back(surface);
  }
  return out;
}

nlohmann::json side(const bake::OneSided& d) {
  return {{"mean", d.mean}, {"rms", d.rms}, {"max", d.max}};
}

nlohmann::json make_report(const Surface& before, const Surface& after, const Surface& stored,
                           double seconds, const bake::RepairReport& repairs,
                           const std::string& lost) {
  const bake::SurfaceFacts a = bake::facts_of(before), b = bake::facts_of(after);
  const bake::SurfaceError e = bake::measure_error(before, after);
  const auto relative = [&](double volume) {
    return a.volume != 0 ? (volume - a.volume) / std::abs(a.volume) : 0.0;
  };
  return {{"faces_in", a.triangles},
          {"faces_out", b.triangles},
          {"seconds", seconds},
          {"volume_change", relative(b.volume)},
          {"stored_volume_change", relative(bake::facts_of(stored).volume)},
          {"hausdorff", e.hausdorff()},
          {"rms", e.rms()},
          {"mean", e.mean()},
          {"original_to_simplified", side(e.forward)},
          {"simplified_to_original", side(e.backward)},
          {"unit_of_errors", "that of the mesh"},
          {"bounding_box_diagonal", a.diagonal},
          {"boundary_kept", a.border_loops == b.border_loops},
          {"boundary_loops", {a.border_loops, b.border_loops}},
          {"boundary_length", {a.border_length, b.border_length}},
          {"euler", {a.euler, b.euler}},
          {"components", {a.components, b.components}},
          {"repairs", repairs.text()},
          {"left_out", lost}};
}

void run_simplify(const SimplifyArgs& args) {
  const bake::MeshFormat format = bake::format_of(args.out), format_in = bake::format_of(args.in);
  Progress progress;
  progress.step("reading");
  bake::RepairReport repairs;
  const std::string text = bake::read_file(args.in);
  const Surface original =
      bake::repair_surface(bake::parse_mesh(text, format_in, args.in), &repairs);
  if (original.triangles.empty()) throw MeshError(args.in + ": no face is left after repair");
  const std::string lost = left_out(text, format_in);
  bake::CollapseOptions options;
  if (!args.lock.empty()) options.locked = read_locks(args.lock, repairs);
  const auto began = std::chrono::steady_clock::now();
  progress.step("simplifying");
  Surface result;
  if (args.history.empty() && args.max_error == 0) {
    options.target_triangles = args.faces;
    result = bake::collapse_edges(original, options);
  } else {
    options.target_triangles = args.history.empty() ? args.faces : 0;
    const bake::History history = bake::record_history(original, options);
    if (args.max_error > 0) {
      const auto watch = [&progress](std::uint32_t faces) {
        progress.step("measuring " + std::to_string(faces) + " faces");
      };
      result = bake::coarsest_within(history, original, args.max_error, args.faces, watch);
    } else {
      bake::HistoryCursor cursor(history);
      cursor.go_to(args.faces);
      result = cursor.surface();
    }
    if (!args.history.empty()) bake::write_file(args.history, bake::format_history(history));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
  const std::string bytes = bake::format_mesh(result, format);
  bake::write_file(args.out, bytes);
  if (!args.report.empty()) {
    progress.step("measuring");
    const Surface stored = bake::parse_mesh(bytes, format, args.out);
    bake::write_file(
        args.report,
        make_report(original, result, stored, seconds.count(), repairs, lost).dump(2) + "\n");
  }
  for (const std::string& note : {repairs.text(), lost})
    if (!note.empty()) warn(args.in + ": " + note);
  std::printf("%zu -> %zu faces in %.3f s\n", original.triangles.size(), result.triangles.size(),
              seconds.count());
}

struct HistoryArgs {
  std::string in, out;
  std::uint32_t faces = 0;
};

void run_history(const HistoryArgs& args) {
  const bake::MeshFormat format = bake::format_of(args.out);
  const bake::History history = bake::parse_history(bake::read_file(args.in), args.in);
  bake::HistoryCursor cursor(history);
  cursor.go_to(args.faces);
  bake::write_file(args.out, bake::format_mesh(cursor.surface(), format));
  std::printf("%u of %zu to %u faces\n", cursor.triangle_count(), history.base.triangles.size(),
              history.max_triangles());
}

}  // namespace

void add_simplify(CLI::App& app) {
  auto args = std::make_shared<SimplifyArgs>();
  CLI::App* c = app.add_subcommand("simplify", "Makes a mesh coarser by memoryless edge collapse");
  c->footer("Example: caryatid-tool simplify bunny.obj --faces 2000 -o small.obj --report r.json");
  reads(c->add_option("IN", args->in, "Mesh: .obj, .off or .ply")->required());
  CLI::Option* faces = c->add_option("--faces", args->faces, "Stop at so many triangles");
  CLI::Option* error =
      c->add_option("--max-error", args->max_error,
                    "Stop before the distance to the original, measured both ways, passes this; in "
                    "units of the mesh. With --faces: whichever comes first");
  error->check(number_from(1e-12, 1e12));
  reads(c->add_option("--lock", args->lock, "Vertices that stay: a number a line, counted from 1"));
  writes(c->add_option("-o,--out", args->out, "Mesh to write: .obj, .off or .ply")->required(),
         {".obj", ".off", ".ply"});
  writes(
      c->add_option("--history", args->history, "Write the way back, for caryatid-tool history"));
  writes(c->add_option("--report", args->report, "Write figures as JSON"));
  on_run(c, [args, faces, error] {
    if (faces->count() == 0 && error->count() == 0)
      throw UsageError("give --faces N or --max-error E");
    run_simplify(*args);
  });
}

void add_history(CLI::App& app) {
  auto args = std::make_shared<HistoryArgs>();
  CLI::App* c = app.add_subcommand("history", "Gives any level out of a recorded history");
  c->footer("Example: caryatid-tool history bunny.history --faces 5000 -o level.obj");
  reads(c->add_option("IN", args->in, "From caryatid-tool simplify --history")->required());
  c->add_option("--faces", args->faces, "At most so many triangles")->required();
  writes(c->add_option("-o,--out", args->out, "Mesh to write: .obj, .off or .ply")->required(),
         {".obj", ".off", ".ply"});
  on_run(c, [args] { run_history(*args); });
}

}  // namespace caryatid::tool
