// caryatid-tool bake font: free fonts to the glyphs that captions are drawn with.
#include <cstdio>
#include <memory>

#include "assets/bake/files/files.h"
#include "assets/bake/font/font.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/numbers.h"

namespace caryatid::tool {
namespace {

struct FontArgs {
  bake::FontRequest request;
  std::string out;
};

void bake_font(FontArgs& a) {
  if (a.request.files.empty())
    for (const char* name :
         {"NotoSans-Regular", "NotoSansHebrew-Regular", "NotoSansArabic-Regular"})
      a.request.files.push_back(std::string("/usr/share/fonts/truetype/noto/") + name + ".ttf");
  bake::FontReport report;
  const std::vector<std::byte> block = bake::bake_font(a.request, &report);
  bake::write_file(a.out, {reinterpret_cast<const char*>(block.data()), block.size()});
  std::printf("%zu glyphs for %zu code points, atlas %.0f %% full, %zu bytes\n", report.glyphs,
              report.code_points, 100.0 * report.atlas_filled, block.size());
}

}  // namespace

void add_bake_font(CLI::App& bake_command) {
  CLI::App* cmd = bake_command.add_subcommand("font", "Glyphs for captions, from free fonts");
  auto a = std::make_shared<FontArgs>();
  reads(cmd->add_option("fonts", a->request.files,
                        "FONT.ttf ..., each for what those before it lack (default: Noto Sans, "
                        "Noto Sans Hebrew, Noto Sans Arabic)"));
  writes(cmd->add_option("-o,--out", a->out, "OUT.font")->required());
  cmd->add_option("--em", a->request.em_px, "Size of the distance field in pixels (default 30)")
      ->check(number_from(12, 64));
  cmd->footer("example: caryatid-tool bake font -o firmware-app/builtin_font.pack");
  on_run(cmd, [a] { bake_font(*a); });
}

}  // namespace caryatid::tool
