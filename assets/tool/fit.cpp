// caryatid-tool fit: the rules of FAP interpolation as text.
#include <cstdio>

#include "assets/bake/face/fit_file.h"
#include "assets/bake/files/files.h"
#include "assets/bake/stream/head_error.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "core/face/fit.h"

namespace caryatid::tool {
namespace {

struct FitArgs {
  std::string in, pack;
};

void fit(const FitArgs& a) {
  std::vector<pack::FitRule> rules;
  if (!a.in.empty()) {
    rules = bake::parse_fit(bake::read_file(a.in), a.in);
  } else {
    const std::span<const pack::FitRule> built_in = face::default_fit();
    rules.assign(built_in.begin(), built_in.end());
    if (!a.pack.empty()) rules = bake::HeadMeter(a.pack).fit();
  }
  std::printf("%s", bake::fit_text(rules).c_str());
}

}  // namespace

void add_fit(CLI::App& app) {
  auto a = std::make_shared<FitArgs>();
  CLI::App* cmd = app.add_subcommand(
      "fit", "Rules that complete streams (FIT): of a text, of a pack, or those built in");
  CLI::Option* in = reads(cmd->add_option("in", a->in, "RULES.fit, checked and printed"));
  reads(cmd->add_option("--pack", a->pack, "The rules of a character"))->excludes(in);
  cmd->footer(
      "example: caryatid-tool fit > mine.fit; edit; caryatid-tool bake character "
      "woman.toml --fit mine.fit -o woman.pack");
  on_run(cmd, [a] { fit(*a); });
}

}  // namespace caryatid::tool
