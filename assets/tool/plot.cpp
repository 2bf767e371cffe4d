// caryatid-tool plot: metrics and FAP files as SVG.
#include <memory>

#include "assets/bake/plot/error_plot.h"
#include "assets/bake/plot/metrics_plot.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/text_file.h"

namespace caryatid::tool {
namespace {

struct PlotArgs {
  std::vector<std::string> in;
  std::string out, title;
};

void write_chart(const bake::Chart& chart, const std::string& path) {
  write_text(path, bake::chart_svg(chart));
}

void plot_metrics(const PlotArgs& args) {
  std::vector<bake::MetricsRun> runs;
  for (const std::string& path : args.in)
    runs.push_back(bake::parse_metrics(read_text(path), path));
  bake::Chart chart = bake::metrics_chart(runs);
  if (!args.title.empty()) chart.title = args.title;
  write_chart(chart, args.out);
}

void plot_fap(const PlotArgs& args) {
  bake::Chart chart = bake::fap_chart(read_text(args.in[0]), args.in[0]);
  if (!args.title.empty()) chart.title = args.title;
  write_chart(chart, args.out);
}

void plot_errors(const PlotArgs& args) {
  bake::Chart chart = bake::error_chart(read_text(args.in[0]), args.in[0]);
  if (!args.title.empty()) chart.title = args.title;
  write_chart(chart, args.out);
}

CLI::App* add_kind(CLI::App& plot, const char* name, const char* what, void (*run)(const PlotArgs&),
                   int most) {
  auto args = std::make_shared<PlotArgs>();
  CLI::App* kind = plot.add_subcommand(name, what);
  reads(kind->add_option("IN", args->in, "File to plot")->required()->expected(1, most));
  writes(kind->add_option("-o,--out", args->out, "SVG file to write")->required(), {".svg"});
  kind->add_option("--title", args->title, "Title instead of the file's name");
  on_run(kind, [args, run] { run(*args); });
  return kind;
}

}  // namespace

void add_plot(CLI::App& app) {
  CLI::App* plot =
      app.add_subcommand("plot", "Draw metrics, animation curves or simplification errors as SVG");
  plot->require_subcommand(1);
  add_kind(*plot, "metrics",
           "Frame time and triangles over time; several files are compared.\n"
           "Example: caryatid-tool plot metrics run.jsonl -o run.svg",
           plot_metrics, 8);
  add_kind(*plot, "fap",
           "The FAPs that move most, by region of the face.\n"
           "Example: caryatid-tool plot fap joy.fap -o joy.svg",
           plot_fap, 1);
  add_kind(*plot, "errors",
           "Error over faces of the simplifier beside its peers, from the benchmark's JSON.\n"
           "Example: caryatid-tool plot errors simplify.json -o errors.svg\n"
           "As PNG, with Debian's librsvg2-bin: rsvg-convert errors.svg -o errors.png",
           plot_errors, 1);
}

}  // namespace caryatid::tool
