// caryatid-tool: for those who make content. Exit codes: 0 done, 1 failed, 2 wrong usage.
#include <cstdio>
#include <exception>

#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"

namespace {

// The sub-command that was called, with those above it: its help has the options.
std::string command_of(const CLI::App& app) {
  std::string name = "caryatid-tool";
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    name += " " + at->get_name();
  }
  return name;
}

int refuse(const CLI::App& app, const char* what) {
  using caryatid::tool::printable;
  std::fprintf(stderr, "caryatid-tool: %s; see %s --help\n", printable(what).c_str(),
               command_of(app).c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"caryatid-tool: makes and looks at what a Caryatid kiosk shows."};
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Help of every subcommand");
  app.set_version_flag("--version", "caryatid-tool " CARYATID_VERSION);
  using namespace caryatid::tool;
  add_bake(app);
  add_clip(app);
  add_fba(app);
  add_fit(app);
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
    return refuse(app, e.what());
  } catch (const UsageError& e) {
    return refuse(app, e.what());
  } catch (const std::exception& e) {
    warn(e.what());
    return 1;
  }
  return 0;
}
