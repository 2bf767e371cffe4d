#pragma once
// Every subcommand of caryatid-tool registers itself on the command line; its work runs in a
// callback and fails by throwing std::runtime_error with one line "FILE:LINE: what; cure".
#include <CLI/CLI.hpp>

namespace caryatid::tool {

void add_bake(CLI::App& app);
void add_bake_font(CLI::App& bake_command);
void add_clip(CLI::App& app);
void add_fba(CLI::App& app);
void add_fit(CLI::App& app);
void add_gait(CLI::App& app);
void add_plot(CLI::App& app);
void add_render(CLI::App& app);
void add_sheet(CLI::App& app);
void add_speech(CLI::App& app);
void add_simplify(CLI::App& app);
void add_history(CLI::App& app);

}  // namespace caryatid::tool
