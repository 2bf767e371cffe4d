// caryatid-tool render: one picture of a pack's person.
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "assets/bake/files/files.h"
#include "assets/bake/gait/settled_walk.h"
#include "assets/tool/bap_axes.h"
#include "assets/tool/command_line.h"
#include "assets/tool/commands.h"
#include "assets/tool/gait_style_named.h"
#include "assets/tool/numbers.h"
#include "assets/tool/studio.h"
#include "core/body/bap_table.h"
#include "core/body/joint_limits.h"
#include "core/emotion/profiles.h"
#include "core/face/fap_fill.h"
#include "core/face/visemes.h"
#include "core/stream/bap_text.h"
#include "core/stream/fap_text.h"

namespace caryatid::tool {
namespace {

struct RenderArgs {
  std::string pack, emotion, fap, set, bap, view = "front", size = "800x800", lod, mood, out;
  int viseme = -1;
  bool wire = false;
  float phase = 0.0f;
  std::string bap_axes = "signed";
  bool joint_limits = false;
};

// "FILE@7" is frame 7 of FILE; without it the first.
template <class Reader, class Frame>
Frame frame_of(const std::string& text) {
  const FrameName name = frame_name(text);
  const std::string content = bake::read_file(name.path);
  Reader reader(content);
  Frame frame;
  for (std::size_t i = 0; i <= name.frame; ++i) {
    const Status s = reader.next(&frame);
    if (s.ok()) continue;
    if (i > 0 && s.detail == static_cast<std::uint16_t>(stream::TextFault::end_of_text))
      throw std::runtime_error(name.path + ": has " + std::to_string(i) +
                               " frames; name one of 0.." + std::to_string(i - 1));
    throw std::runtime_error(name.path + ":" + std::to_string(reader.line()) + ": " +
                             stream::describe_text_fault(s));
  }
  return frame;
}

// No stream holds more.
constexpr double kMostFap = 32768;

void set_faps(const std::string& text, face::FapFrame* out) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string item = text.substr(at, end - at);
    const std::size_t equals = std::min(item.find('='), item.size());
    const auto fap = number_within(item.substr(0, equals), 3, face::kFapCount);
    const auto value =
        number_within(item.substr(std::min(equals + 1, item.size())), -kMostFap, kMostFap);
    if (!fap || !value || *fap != std::floor(*fap))
      throw UsageError("--set " + item +
                       ": wanted FAP=VALUE with FAP 3..68 and VALUE -32768..32768");
    out->set(static_cast<int>(*fap), static_cast<float>(*value));
    at = end + 1;
  }
}

// The walk's pose at a share of the cycle of the left leg, on the spot.
body::BapFrame walking(const body::Skeleton& skeleton, const std::string& mood, float phase) {
  bake::SettledWalk walk(skeleton, style_named(mood));
  body::BapFrame frame = walk.to_phase(phase);
  frame.set(182, 0.0f);
  frame.set(183, 0.0f);
  return frame;
}

void keep_joints(Pose* pose) {
  const body::LimitReport limits = body::limit_joints(pose->baps, pose->bap_axes);
  if (limits.bitten > 0)
    std::printf("%d joint angles beyond human limits, the farthest %s by %.0f degrees\n",
                limits.bitten, body::bap_info(limits.worst_bap).name,
                static_cast<double>(limits.worst_excess_rad) * 57.29578);
}

std::pair<std::uint32_t, std::uint32_t> size_named(const std::string& text) {
  const std::size_t x = std::min(text.find('x'), text.size());
  const auto w = number_within(text.substr(0, x), 16, 2048);
  const auto h = number_within(text.substr(std::min(x + 1, text.size())), 16, 2048);
  if (!w || !h || *w != std::floor(*w) || *h != std::floor(*h))
    throw UsageError("--size " + text + ": wanted WIDTHxHEIGHT, 16..2048 each");
  return {static_cast<std::uint32_t>(*w), static_cast<std::uint32_t>(*h)};
}

void render(const RenderArgs& a) {
  const auto [w, h] = size_named(a.size);
  if (!a.mood.empty()) (void)style_named(a.mood);  // A wrong name is said before the pack is read.
  Studio studio(a.pack, w, h);
  Pose pose;
  pose.view = view_named(a.view);
  pose.wire = a.wire;
  if (!a.lod.empty()) set_lod(a.lod, &pose);
  if (!a.emotion.empty()) pose.faps = emotion_named(a.emotion);
  if (a.viseme >= 0) pose.faps = face::viseme_frame(a.viseme);
  if (!a.fap.empty()) {
    pose.faps = frame_of<stream::FapTextReader, face::FapFrame>(a.fap);
    pose.absolute = true;
    face::expand_viseme(pose.faps);
    emotion::expand_expression(pose.faps);
    face::fill_from_partners(&pose.faps, studio.person().fit());
  }
  set_faps(a.set, &pose.faps);
  if (!a.bap.empty()) {
    pose.baps = frame_of<stream::BapTextReader, body::BapFrame>(a.bap);
    pose.bap_axes = bap_axes_named(a.bap_axes);
  }
  if (a.joint_limits) keep_joints(&pose);
  if (!a.mood.empty()) pose.baps = walking(studio.person().skeleton(), a.mood, a.phase);
  write_png(studio.picture(pose), a.out);
}

}  // namespace

void add_render(CLI::App& app) {
  auto a = std::make_shared<RenderArgs>();
  CLI::App* cmd = app.add_subcommand("render", "A picture of the person of a pack");
  reads(cmd->add_option("--pack", a->pack, "The character")->required());
  cmd->add_option("--emotion", a->emotion, "NAME or NAME:0..1");
  reads_frame(cmd->add_option("--fap", a->fap, "FILE or FILE@FRAME of a .fap text, from 0"));
  cmd->add_option("--set", a->set, "FAP=VALUE,... in the FAP's own unit");
  cmd->add_option("--viseme", a->viseme, "0..14")->check(number_from(0, 14));
  reads_frame(cmd->add_option("--bap", a->bap, "FILE or FILE@FRAME of a .bap text, from 0"));
  add_bap_axes(cmd, &a->bap_axes);
  cmd->add_flag("--joint-limits", a->joint_limits,
                "Keep joints within human limits and say which were exceeded");
  cmd->add_option("--mood", a->mood,
                  "Walking: normal bored happy sad angry hurried tired proud run, or A,E on the "
                  "activation-evaluation plane (-1..1)");
  cmd->add_option("--phase", a->phase, "Of the left leg's walking cycle, 0..1")
      ->check(number_from(0, 1));
  cmd->add_option("--view", a->view, "front left right three-quarter bust body feet");
  cmd->add_option("--lod", a->lod, "Triangles: N of the whole person, or head=N (default all)");
  cmd->add_flag("--wire", a->wire, "The edges of the triangles, hidden ones left out");
  cmd->add_option("--size", a->size, "WIDTHxHEIGHT (default 800x800)");
  writes(cmd->add_option("-o,--out", a->out, "OUT.png")->required(), {".png"});
  cmd->footer("example: caryatid-tool render --pack woman.pack --emotion joy:0.7 -o joy.png");
  on_run(cmd, [a] { render(*a); });
}

}  // namespace caryatid::tool
