// caryatid-tool: for those who make content. Exit codes: 0 done, 1 failed, 2 wrong usage.
#include <cstdio>
#include <exception>

#include "assets/tool/commands.h"

int main(int argc, char** argv) {
  CLI::App app{"caryatid-tool: makes and looks at what a Caryatid kiosk shows."};
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Help of every subcommand");
  using namespace caryatid::tool;
  add_bake(app);
  add_clip(app);
  add_fba(app);
  add_gait(app);
  add_plot(app);
  add_render(app);
  add_sheet(app);
  add_speech(app);
  add_simplify(app);
  add_history(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "caryatid-tool: %s; see caryatid-tool --help\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "caryatid-tool: %s\n", e.what());
    return 1;
  }
  return 0;
}
