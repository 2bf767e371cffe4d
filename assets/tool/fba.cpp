// caryatid-tool fba: FBA streams from and to text, what is in them, and what rate costs in error.
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "assets/bake/face/fit_file.h"
#include "assets/bake/files/files.h"
#include "assets/bake/stream/clip_files.h"
#include "assets/bake/stream/epf.h"
#include "assets/bake/stream/head_error.h"
#include "assets/bake/stream/rate_plot.h"
#include "assets/bake/stream/talking_track.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/numbers.h"

namespace caryatid::tool {
namespace {

using bake::AnimationClip;

constexpr double kNoLimit = 1000000;  // kbit/s: the rate is reported only.

struct FbaArgs {
  std::vector<std::string> in;
  std::string out, epf, plot, pack, fit;
  int quant = 1, bap_quant = 1, intra_every = 0;
  double fps = 0.0, kbps = 0.0, seconds = 60.0;
  unsigned seed = 1;
  bool standard_steps = false, no_start_codes = false;

  body::BapQuantisers quantisers() const {
    return standard_steps ? body::BapQuantisers::standard : body::BapQuantisers::visage;
  }
};

void print_faults(const std::string& path, const bake::FbaReport& report) {
  for (const std::string& fault : report.faults) warn(path + ": " + fault);
}

void info(const FbaArgs& a) {
  for (const std::string& path : a.in) {
    bake::FbaReport r;
    bake::read_fba(path, {a.quantisers()}, &r);
    print_faults(path, r);
    const double bits = static_cast<double>(r.bytes) * 8.0;
    std::printf("%s: %zu bytes, %zu planes (%zu intra, %zu damaged), %.4g frames/s, %.2f s, ",
                path.c_str(), r.bytes, r.planes, r.intra_planes, r.damaged_planes, r.rate.hertz(),
                r.seconds);
    std::printf("%.2f kbit/s\n", r.seconds > 0.0 ? bits / 1000.0 / r.seconds : 0.0);
    if (r.coding.face_known) {
      std::printf("  face: quantiser %d, FAPs", r.coding.fap_quant);
      for (std::size_t fap = 1; fap <= face::kFapCount; ++fap)
        if (r.coding.fap_mask.test(fap)) std::printf(" %zu", fap);
      std::printf("\n");
    }
    if (r.coding.body_known) {
      std::printf("  body: quantiser index %d, BAPs", r.coding.bap_quant_index);
      for (std::size_t bap = 1; bap <= body::kBapCountExtended; ++bap)
        if (r.coding.bap_mask.test(bap)) std::printf(" %zu", bap);
      std::printf("\n");
    }
    if (r.planes == 0) throw std::runtime_error(path + ": no plane could be decoded; give an .fba");
  }
}

void decode(const FbaArgs& a) {
  bake::FbaReport report;
  const AnimationClip clip = bake::read_fba(a.in.front(), {a.quantisers()}, &report);
  print_faults(a.in.front(), report);
  if (clip.size() == 0)
    throw std::runtime_error(a.in.front() + ": no plane could be decoded; give an .fba stream");
  const bool face = !clip.face.empty(), body = !clip.body.empty();
  const bool fap = a.out.ends_with(".fap"), bap = a.out.ends_with(".bap");
  if (!fap && !bap) throw UsageError("--out " + a.out + ": name OUT.fap or OUT.bap");
  if ((bap && !body) || (fap && !face))
    throw std::runtime_error(a.in.front() + (body ? ": has a body and no face; name OUT.bap"
                                                  : ": has a face and no body; name OUT.fap"));
  const std::string stem = a.out.substr(0, a.out.size() - 4);
  claim(a.in, {stem + ".fap", stem + ".bap"});
  if (face) bake::write_fap(clip, stem + ".fap");
  if (body) bake::write_bap(clip, stem + ".bap");
}

AnimationClip read_texts(const std::vector<std::string>& paths) {
  AnimationClip clip;
  std::vector<std::string> notes;
  for (const std::string& path : paths) bake::read_text(path, &clip, &notes);
  for (const std::string& note : notes) warn(note);
  return clip;
}

// The body takes what the face leaves: the finest steps that fit.
void fit_rate(const FbaArgs& a, const stream::FbaClip& clip, stream::FbaSettings* io_settings) {
  std::vector<stream::ModelNode> nodes(1 << 20);
  if (clip.body.empty()) {
    stream::RatePlan plan;
    const Status status = stream::plan_rate(clip, a.kbps, nodes, io_settings, &plan);
    if (!status.ok()) throw std::runtime_error(stream::describe_fba_fault(status));
    return;
  }
  const double seconds = static_cast<double>(clip.size()) / io_settings->rate.hertz();
  for (int index = 1; index < 32; ++index) {
    io_settings->bap_quant_index = static_cast<std::uint8_t>(index);
    io_settings->fap_quant = io_settings->bap_quant_index;
    stream::set_ranges(clip, io_settings);
    const auto bits = stream::measure_bits(clip, *io_settings, nodes);
    if (bits.ok() && static_cast<double>(bits.value) / 1000.0 / seconds <= a.kbps) return;
  }
  throw std::runtime_error(stream::describe(stream::FbaFault::rate_too_low));
}

void encode(const FbaArgs& a) {
  AnimationClip clip = read_texts(a.in);
  if (!a.fit.empty()) clip.fit = bake::parse_fit(bake::read_file(a.fit), a.fit);
  std::vector<std::byte> bytes;
  if (!a.epf.empty()) {
    bytes = bake::encode_by_epf(clip, bake::read_epf(a.epf), a.epf);
  } else {
    if (a.fps > 0.0) bake::resample(a.fps, &clip);
    stream::FbaSettings settings;
    settings.rate = bake::rate_of(clip.frames_per_second);
    settings.fap_quant = static_cast<std::uint8_t>(a.quant);
    settings.bap_quant_index = static_cast<std::uint8_t>(a.bap_quant);
    settings.quantisers = a.quantisers();
    settings.plane_start_codes = !a.no_start_codes;
    const auto every = static_cast<std::size_t>(a.intra_every);
    stream::set_masks(clip.view(every), &settings);
    stream::set_ranges(clip.view(every), &settings);
    if (a.kbps > 0.0 && a.kbps < kNoLimit) {
      settings.repeat_ranges = false;
      fit_rate(a, clip.view(every), &settings);
    }
    bytes = bake::encode_fba(clip, every, settings);
  }
  bake::write_file(a.out, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  bake::FbaReport report;
  const AnimationClip back = bake::read_fba(a.out, {a.quantisers()}, &report);
  print_faults(a.out, report);
  std::printf("%s: %zu bytes, %zu planes, %.3f kbit/s", a.out.c_str(), bytes.size(), report.planes,
              static_cast<double>(bytes.size()) * 8.0 / 1000.0 / report.seconds);
  if (!clip.face.empty() && a.epf.empty()) {
    const bake::PointError error = bake::point_error(clip.face, back.face);
    std::printf(", point error mean %.3f mm, 99 %% %.3f mm, largest %.3f mm (estimate)",
                error.mean_mm, error.p99_mm, error.largest_mm);
  }
  std::printf("\n");
}

void track(const FbaArgs& a) {
  AnimationClip clip;
  clip.frames_per_second = a.fps > 0.0 ? a.fps : 25.0;
  clip.face = bake::make_talking_track(a.seconds, clip.frames_per_second, a.seed);
  bake::write_fap(clip, a.out);
}

void rate(const FbaArgs& a) {
  AnimationClip clip = read_texts(a.in);
  if (clip.face.empty()) throw std::runtime_error(a.in.front() + ": no face; give a .fap");
  clip.body.clear();
  if (a.fps > 0.0) bake::resample(a.fps, &clip);
  bake::Measure measure = bake::point_error;
  if (!a.pack.empty()) {
    const auto head = std::make_shared<bake::HeadMeter>(a.pack);
    clip.fit = head->fit();
    measure = [head](const auto& original, const auto& decoded) {
      return head->measure(original, decoded);
    };
  }
  const auto points = bake::measure_rates(clip, static_cast<std::size_t>(a.intra_every), measure);
  std::printf("kbit/s  step mm  FAPs  mean mm   99 %% mm\n");
  for (const bake::RatePoint& p : points)
    std::printf("%6.3f  %7.3f  %4zu  %7.3f  %8.3f\n", p.kbit_per_s, static_cast<double>(p.step_mm),
                p.fap_count, p.error.mean_mm, p.error.p99_mm);
  if (!a.plot.empty()) bake::write_file(a.plot, bake::plot_rates(points));
}

CLI::App* command(CLI::App* fba, const std::shared_ptr<FbaArgs>& a, const char* name,
                  const char* what, void (*work)(const FbaArgs&), const char* example) {
  CLI::App* cmd = fba->add_subcommand(name, what);
  cmd->footer(std::string("example: caryatid-tool fba ") + example);
  on_run(cmd, [a, work] { work(*a); });
  return cmd;
}

}  // namespace

void add_fba(CLI::App& app) {
  auto a = std::make_shared<FbaArgs>();
  CLI::App* fba = app.add_subcommand("fba", "MPEG-4 face and body animation streams");
  fba->require_subcommand(1);

  CLI::App* cmd =
      command(fba, a, "info", "What is in a stream, and its rate", info, "info hello.fba");
  reads(cmd->add_option("in", a->in, "IN.fba")->required());
  cmd->add_flag("--standard-steps", a->standard_steps, "Body steps of the standard, not visage's");

  cmd = command(fba, a, "decode", "Stream to .fap and .bap text", decode,
                "decode hello.fba -o hello.fap");
  reads(cmd->add_option("in", a->in, "IN.fba")->required()->expected(1));
  writes(cmd->add_option("-o,--out", a->out, "OUT.fap; a body goes to OUT.bap")->required(),
         {".fap", ".bap"});
  cmd->add_flag("--standard-steps", a->standard_steps, "Body steps of the standard, not visage's");

  cmd = command(fba, a, "encode", "Text to a stream; prints its rate", encode,
                "encode talk.fap -o talk.fba --kbps 2");
  reads(cmd->add_option("in", a->in, "IN.fap, IN.bap or both")->required()->expected(1, 2));
  writes(cmd->add_option("-o,--out", a->out, "OUT.fba")->required(), {".fba"});
  cmd->add_option("--quant", a->quant, "Face quantiser (1)")->check(number_from(0, 31));
  cmd->add_option("--bap-quant", a->bap_quant, "Body quantiser index (1)")
      ->check(number_from(0, 31));
  cmd->add_option("--fps", a->fps, "Frames a second; the text is resampled")
      ->check(number_from(0.1, 255.0));
  reads(cmd->add_option("--fit", a->fit,
                        "RULES.fit of the player, for --kbps (default: built in; see fit)"));
  cmd->add_option("--kbps", a->kbps, "Report the rate; with a number, keep to it")
      ->expected(0, 1)
      ->default_str("1000000")  // kNoLimit
      ->check(number_from(0.01, kNoLimit));
  cmd->add_option("--intra", a->intra_every, "Frames between intra planes (0: the first only)")
      ->check(number_from(0, 100000));
  reads(cmd->add_option("--epf", a->epf,
                        "Encoder parameter file, as of visage: words and numbers that say plane by "
                        "plane what is sent, as FBM 1 ISI 1 FFR 0 (face, intra, frame 0)"));
  cmd->add_flag("--standard-steps", a->standard_steps, "Body steps of the standard, not visage's");
  cmd->add_flag("--no-start-codes", a->no_start_codes, "None before intra planes");

  cmd = command(fba, a, "track", "A talking track for trying faces and streams", track,
                "track -o talk.fap --seconds 60");
  writes(cmd->add_option("-o,--out", a->out, "OUT.fap")->required(), {".fap"});
  cmd->add_option("--seconds", a->seconds, "Length (60)")->check(number_from(1.0, 3600.0));
  cmd->add_option("--fps", a->fps, "Frames a second (25)")->check(number_from(1.0, 120.0));
  cmd->add_option("--seed", a->seed, "Another number, another track (1)");

  cmd =
      command(fba, a, "rate", "What error each rate costs", rate, "rate talk.fap --plot rate.svg");
  reads(cmd->add_option("in", a->in, "IN.fap")->required()->expected(1));
  cmd->add_option("--fps", a->fps, "Frames a second; the text is resampled")
      ->check(number_from(0.1, 255.0));
  cmd->add_option("--intra", a->intra_every, "Frames between intra planes (0: the first only)")
      ->check(number_from(0, 100000));
  reads(cmd->add_option("--pack", a->pack,
                        "Measure on this head (default: estimate by adult means)"));
  writes(cmd->add_option("--plot", a->plot, "OUT.svg"), {".svg"});
}

}  // namespace caryatid::tool
