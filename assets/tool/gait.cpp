// caryatid-tool gait: walks from moods, and moods from walks.
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "assets/bake/gait/analyse.h"
#include "assets/bake/gait/figure.h"
#include "assets/bake/gait/measure.h"
#include "assets/bake/gait/settled_walk.h"
#include "assets/tool/bap_axes.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/gait_style_named.h"
#include "assets/tool/numbers.h"
#include "assets/tool/text_file.h"
#include "core/stream/bap_text.h"

namespace caryatid::tool {
namespace {

struct SynthArgs {
  std::string mood = "normal", out, plot, strip;
  bool run = false, linear = false;
  int frames = 64;
  float fps = 30.0f;
};
struct AnalyseArgs {
  std::string in, report, plot;
  std::string bap_axes = "signed";
};

// Steady walking along +Z from a heel strike of the right foot, at the origin.
std::vector<body::BapFrame> walk(const body::GaitStyle& style, bool linear, int count, float fps) {
  const body::Skeleton skeleton = body::upright_skeleton();
  bake::SettledWalk settled(
      skeleton, style, linear ? body::GaitInterpolation::linear : body::GaitInterpolation::smooth);
  auto frames = settled.record(count, fps);
  const float start_mm = frames.front().get(183);
  for (body::BapFrame& frame : frames) frame.set(183, frame.get(183) - start_mm);
  return frames;
}

std::string bap_text(const std::vector<body::BapFrame>& frames, const std::string& name,
                     float fps) {
  std::string text = "3.1 " + name + " " + std::to_string(static_cast<int>(std::lround(fps))) +
                     " " + std::to_string(frames.size()) + "\n";
  std::vector<char> line(stream::kMaxBapTextFrameBytes);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto written = stream::write_bap_text(static_cast<std::int32_t>(i), frames[i], line);
    if (!written.ok()) throw std::runtime_error("a frame could not be written as text");
    text.append(line.data(), written.value);
  }
  return text;
}

void print_fit(const char* name, const bake::CycleCurves& curves) {
  const bake::NormativeFit fit = bake::fit_to_norm(curves);
  const auto percent = [](float share) { return std::lround(100.0f * share); };
  std::printf(
      "%s: within 2 SD of the norm over %ld %% (hip), %ld %% (knee), %ld %% (ankle), "
      "%ld %% (list), %ld %% (rotation) of the cycle\n",
      name, percent(fit.hip), percent(fit.knee), percent(fit.ankle), percent(fit.list),
      percent(fit.rotation));
}

void synth(const SynthArgs& a) {
  const body::GaitStyle style = a.run ? body::running_style() : style_named(a.mood);
  const std::string name = a.run ? "run" : a.mood;
  const auto frames = walk(style, a.linear, a.frames, a.fps);
  write_text(a.out, bap_text(frames, name, a.fps));
  const body::Skeleton skeleton = body::upright_skeleton();
  const auto m = bake::measure_walk(skeleton, frames, a.fps, bake::outline_points(skeleton));
  std::printf("speed %.2f m/s, slide %.2f mm a frame, below floor %.2f mm, pelvis travel %.1f mm\n",
              double(m.speed_mps), double(m.slide_m) * 1e3, double(m.below_floor_m) * 1e3,
              double(m.pelvis_travel_m) * 1e3);
  if (!a.plot.empty()) {
    const bake::CycleCurves smooth = bake::walked_curves(style);
    const bake::CycleCurves linear = bake::walked_curves(style, body::GaitInterpolation::linear);
    print_fit("smooth", smooth);
    print_fit("linear", linear);
    const bake::NamedCurves curves[] = {{name, &smooth}, {"linear", &linear}};
    write_text(a.plot, bake::curves_svg(curves));
  }
  if (!a.strip.empty()) {
    const auto cycle = walk(style, a.linear, 16, 16.0f / style.cycle_s);
    const bake::FigureStrip strips[] = {{name + ", side", cycle, bake::FigureView::side, {}},
                                        {name + ", front", cycle, bake::FigureView::front, {}}};
    write_text(a.strip, bake::figure_svg(skeleton, strips));
  }
}

bake::Motion motion_of_bap(const std::string& text, const std::string& path,
                           body::BapConvention axes) {
  stream::BapTextReader reader(text);
  const auto check = [&](Status status, const char* what) {
    if (!status.ok())
      throw std::runtime_error(path + ":" + std::to_string(reader.line()) + ": " + what +
                               "; is this a whole .bap text?");
  };
  check(reader.read_header(), "no header");
  std::vector<body::BapFrame> frames;
  body::BapFrame frame;
  for (;;) {
    const Status status = reader.next(&frame);
    if (status.code == Code::not_ready) break;
    check(status, "bad frame");
    frames.push_back(frame);
    if (frames.size() > 1'000'000) throw std::runtime_error(path + ": more than a million frames");
  }
  return bake::motion_of(body::upright_skeleton(), frames,
                         static_cast<float>(reader.header().frames_per_second), axes);
}

void analyse(const AnalyseArgs& a) {
  const std::string text = read_text(a.in);
  bake::Motion motion;
  if (a.in.ends_with(".bvh")) {
    motion = bake::motion_of(bake::read_bvh(text, a.in));
  } else if (a.in.ends_with(".csv")) {
    motion = bake::motion_of_csv(text, a.in);
  } else if (a.in.ends_with(".bap")) {
    motion = motion_of_bap(text, a.in, bap_axes_named(a.bap_axes));
  } else {
    throw UsageError(a.in + ": unknown kind of file; give a .bvh, .bap or .csv");
  }
  bake::GaitAnalysis analysis;
  try {
    analysis = bake::analyse_gait(motion);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(a.in + ": " + e.what());
  }
  const std::string report = bake::report_json(analysis);
  if (a.report.empty())
    std::fputs(report.c_str(), stdout);
  else
    write_text(a.report, report);
  if (!a.plot.empty()) {
    const bake::NamedCurves curves[] = {{"measured", &analysis.measured},
                                        {"resynthesis", &analysis.resynthesised}};
    write_text(a.plot, bake::curves_svg(curves));
  }
}

}  // namespace

void add_gait(CLI::App& app) {
  CLI::App* gait = app.add_subcommand("gait", "Walks from moods, and moods from walks");
  gait->require_subcommand(1);
  auto s = std::make_shared<SynthArgs>();
  CLI::App* synth_cmd = gait->add_subcommand("synth", "A steady walk as a .bap text");
  CLI::Option* mood =
      synth_cmd->add_option("--mood", s->mood,
                            "normal bored happy sad angry hurried tired proud, or A,E on the "
                            "activation-evaluation plane (-1..1)");
  synth_cmd->add_flag("--run", s->run, "The run in place of a mood's walk")->excludes(mood);
  synth_cmd->add_flag("--linear", s->linear, "Linear interpolation of the key poses");
  synth_cmd->add_option("--frames", s->frames, "How many frames (default 64)")
      ->check(number_from(1, 100000));
  synth_cmd->add_option("--fps", s->fps, "Frames a second (default 30)")
      ->check(number_from(5, 240));
  writes(synth_cmd->add_option("--plot", s->plot, "Joint curves beside the norm: OUT.svg"),
         {".svg"});
  writes(synth_cmd->add_option("--strip", s->strip, "16 stick figures, side and front: OUT.svg"),
         {".svg"});
  writes(synth_cmd->add_option("-o,--out", s->out, "OUT.bap")->required(), {".bap"});
  synth_cmd->footer("example: caryatid-tool gait synth --mood sad --frames 64 -o sad.bap");
  on_run(synth_cmd, [s] { synth(*s); });

  auto a = std::make_shared<AnalyseArgs>();
  CLI::App* analyse_cmd =
      gait->add_subcommand("analyse", "Cycles, phases, mood and parametric form of a capture");
  reads(analyse_cmd->add_option("in", a->in, "IN.bvh, IN.bap or IN.csv")->required());
  writes(analyse_cmd->add_option("--report", a->report, "OUT.json (default: stdout)"), {".json"});
  writes(analyse_cmd->add_option("--plot", a->plot, "Measured and resynthesised curves: OUT.svg"),
         {".svg"});
  add_bap_axes(analyse_cmd, &a->bap_axes);
  analyse_cmd->footer(
      "example: caryatid-tool gait analyse walk.bvh --report walk.json --plot walk.svg");
  on_run(analyse_cmd, [a] { analyse(*a); });
}

}  // namespace caryatid::tool
