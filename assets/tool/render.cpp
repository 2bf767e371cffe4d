// caryatid-tool render: one picture of a pack's person.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "assets/bake/gait/settled_walk.h"
#include "assets/tool/commands.h"
#include "assets/tool/gait_style_named.h"
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
  const std::size_t at = text.rfind('@');
  const std::string path = text.substr(0, at);
  const int wanted = at == std::string::npos ? 0 : std::atoi(text.c_str() + at + 1);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": can't be read; name a file that can");
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  Reader reader(content);
  Frame frame;
  for (int i = 0; i <= wanted; ++i)
    if (const Status s = reader.next(&frame); !s.ok())
      throw std::runtime_error(path + ":" + std::to_string(reader.line()) + ": " +
                               stream::describe_text_fault(s));
  return frame;
}

void set_faps(const std::string& text, face::FapFrame* out) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    int fap = 0, used = 0;
    float value = 0.0f;
    const std::string item = text.substr(at, end - at);
    if (std::sscanf(item.c_str(), "%d=%f%n", &fap, &value, &used) != 2 ||
        used != static_cast<int>(item.size()) || fap < 3 || fap > face::kFapCount)
      throw std::runtime_error("--set " + item + ": wanted FAP=VALUE with FAP 3..68");
    out->set(fap, value);
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

body::BapConvention axes_named(const std::string& name) {
  if (name == "plain") return body::BapConvention::plain_axes;
  return name == "reversed" ? body::BapConvention::signed_axes_reversed
                            : body::BapConvention::signed_axes;
}

void keep_joints(Pose* pose) {
  const body::LimitReport limits = body::limit_joints(pose->baps, pose->bap_axes);
  if (limits.bitten > 0)
    std::printf("%d joint angles beyond human limits, the farthest %s by %.0f degrees\n",
                limits.bitten, body::bap_info(limits.worst_bap).name,
                static_cast<double>(limits.worst_excess_rad) * 57.29578);
}

void render(const RenderArgs& a) {
  unsigned w = 0, h = 0;
  if (std::sscanf(a.size.c_str(), "%ux%u", &w, &h) != 2 || w < 16 || h < 16 || w > 2048 || h > 2048)
    throw std::runtime_error("--size " + a.size + ": wanted WIDTHxHEIGHT, 16..2048 each");
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
    face::fill_from_partners(&pose.faps);
  }
  set_faps(a.set, &pose.faps);
  if (!a.bap.empty()) {
    pose.baps = frame_of<stream::BapTextReader, body::BapFrame>(a.bap);
    pose.bap_axes = axes_named(a.bap_axes);
  }
  if (a.joint_limits) keep_joints(&pose);
  Studio studio(a.pack, w, h);
  if (!a.mood.empty()) pose.baps = walking(studio.person().skeleton(), a.mood, a.phase);
  write_png(studio.picture(pose), a.out);
}

}  // namespace

void add_render(CLI::App& app) {
  auto a = std::make_shared<RenderArgs>();
  CLI::App* cmd = app.add_subcommand("render", "A picture of the person of a pack");
  cmd->add_option("--pack", a->pack, "The character")->required();
  cmd->add_option("--emotion", a->emotion, "NAME or NAME:0..1");
  cmd->add_option("--fap", a->fap, "FILE or FILE@FRAME of a .fap text");
  cmd->add_option("--set", a->set, "FAP=VALUE,... in the FAP's own unit");
  cmd->add_option("--viseme", a->viseme, "0..14")->check(CLI::Range(0, 14));
  cmd->add_option("--bap", a->bap, "FILE or FILE@FRAME of a .bap text");
  cmd->add_option("--bap-axes", a->bap_axes, "How its BAPs turn joints: signed reversed plain")
      ->check(CLI::IsMember({"signed", "reversed", "plain"}));
  cmd->add_flag("--joint-limits", a->joint_limits,
                "Keep joints within human limits and say which were exceeded");
  cmd->add_option("--mood", a->mood,
                  "Walking: normal bored happy sad angry hurried tired proud run");
  cmd->add_option("--phase", a->phase, "Of the left leg's walking cycle, 0..1")
      ->check(CLI::Range(0.0f, 1.0f));
  cmd->add_option("--view", a->view, "front left right three-quarter bust body feet");
  cmd->add_option("--lod", a->lod, "Triangles: N of the whole person, or head=N (default all)");
  cmd->add_flag("--wire", a->wire, "The edges of the triangles, hidden ones left out");
  cmd->add_option("--size", a->size, "WIDTHxHEIGHT (default 800x800)");
  cmd->add_option("-o,--out", a->out, "OUT.png")->required();
  cmd->footer("example: caryatid-tool render --pack woman.pack --emotion joy:0.7 -o joy.png");
  cmd->callback([a] { render(*a); });
}

}  // namespace caryatid::tool
