#include "assets/bake/gait/motion.h"

#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/body/ik.h"
#include "core/body/pose.h"

namespace caryatid::bake {
namespace {

using body::HanimJoint;

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (cell.back() == '\r' || cell.back() == ' ')) cell.remove_suffix(1);
    while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

Vec3 swung(float forward_deg, float length_m) {
  const float a = forward_deg * 0.0174532925f;
  return {0.0f, -length_m * std::cos(a), length_m * std::sin(a)};
}

}  // namespace

Motion motion_of(const Bvh& bvh) {
  struct Names {
    int hip, knee, ankle, toe, shoulder, elbow, wrist;
  };
  const std::array<Names, 2> side = {
      Names{bvh.find({"lfemur", "LeftUpLeg", "LHip", "LeftHip", "l_hip", "lThigh"}),
            bvh.find({"ltibia", "LeftLeg", "LKnee", "LeftKnee", "l_knee", "lShin"}),
            bvh.find({"lfoot", "LeftFoot", "LAnkle", "LeftAnkle", "l_ankle"}),
            bvh.find({"ltoes", "LeftToeBase", "LToe", "LeftToe", "l_metatarsal"}),
            bvh.find({"lhumerus", "LeftArm", "LShoulder", "l_shoulder", "lShldr"}),
            bvh.find({"lradius", "LeftForeArm", "LElbow", "l_elbow", "lForeArm"}),
            bvh.find({"lwrist", "lhand", "LeftHand", "LWrist", "l_wrist"})},
      Names{bvh.find({"rfemur", "RightUpLeg", "RHip", "RightHip", "r_hip", "rThigh"}),
            bvh.find({"rtibia", "RightLeg", "RKnee", "RightKnee", "r_knee", "rShin"}),
            bvh.find({"rfoot", "RightFoot", "RAnkle", "RightAnkle", "r_ankle"}),
            bvh.find({"rtoes", "RightToeBase", "RToe", "RightToe", "r_metatarsal"}),
            bvh.find({"rhumerus", "RightArm", "RShoulder", "r_shoulder", "rShldr"}),
            bvh.find({"rradius", "RightForeArm", "RElbow", "r_elbow", "rForeArm"}),
            bvh.find({"rwrist", "rhand", "RightHand", "RWrist", "r_wrist"})}};
  const int neck = bvh.find({"lowerneck", "Neck", "thorax", "vc7", "Chest"});
  const int head = bvh.find({"head", "skullbase", "upperneck"});
  Motion m{.fps = 1.0f / bvh.frame_s, .has_arms = true, .has_trunk = neck >= 0, .frames = {}};
  for (const Names& n : side) {
    if (n.hip < 0 || n.knee < 0 || n.ankle < 0 || n.toe < 0)
      throw std::runtime_error("no legs by known names (hip, knee, ankle, toe); rename the joints");
    if (n.shoulder < 0 || n.elbow < 0 || n.wrist < 0) m.has_arms = false;
  }
  for (std::size_t f = 0; f < bvh.frame_count; ++f) {
    const std::vector<Vec3> at = bvh.positions(f);
    const auto place = [&](int j) { return j < 0 ? Vec3(0.0f) : at[static_cast<std::size_t>(j)]; };
    MotionFrame frame;
    for (std::size_t s = 0; s < 2; ++s) {
      const Names& n = side[s];
      frame.side[s] = {place(n.hip),      place(n.knee),  place(n.ankle), place(n.toe),
                       place(n.shoulder), place(n.elbow), place(n.wrist)};
    }
    frame.pelvis = 0.5f * (frame.side[0].hip + frame.side[1].hip);
    frame.neck = place(neck);
    frame.head = place(head);
    m.frames.push_back(frame);
  }
  return m;
}

Motion motion_of(const body::Skeleton& s, std::span<const body::BapFrame> frames, float fps,
                 body::BapConvention convention) {
  Motion m{.fps = fps, .has_arms = true, .has_trunk = true, .frames = {}};
  std::vector<Affine> pose(body::kHanimJointCount);
  for (const body::BapFrame& f : frames) {
    (void)body::PoseJob{.skeleton = &s, .baps = &f, .convention = convention, .out = pose}.run();
    const auto at = [&](HanimJoint j) { return joint_position(s, pose, j); };
    MotionFrame frame;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto on = [&](HanimJoint l) { return at(i == 0 ? l : body::mirrored(l)); };
      frame.side[i] = {on(HanimJoint::l_hip),      on(HanimJoint::l_knee),
                       on(HanimJoint::l_ankle),    on(HanimJoint::l_metatarsal),
                       on(HanimJoint::l_shoulder), on(HanimJoint::l_elbow),
                       on(HanimJoint::l_wrist)};
    }
    frame.pelvis = 0.5f * (frame.side[0].hip + frame.side[1].hip);
    frame.neck = at(HanimJoint::vc7);
    frame.head = at(HanimJoint::skullbase);
    m.frames.push_back(frame);
  }
  return m;
}

Motion motion_of_csv(std::string_view text, const std::string& file_name) {
  const body::Skeleton s = body::upright_skeleton();
  const float thigh_m = body::upper_length(s, body::leg(true));
  const float shank_m = body::lower_length(s, body::leg(true));
  int line_number = 0;
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(
        file_name + (line_number > 0 ? ":" + std::to_string(line_number) : "") + ": " + what);
  };
  std::map<std::string, std::size_t, std::less<>> column;
  Motion m;
  float first_s = 0.0f, last_s = 0.0f;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const auto cells = split(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line_number;
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (column.empty()) {
      for (std::size_t c = 0; c < cells.size(); ++c) column.emplace(cells[c], c);
      for (const char* name :
           {"time_s", "l_thigh", "l_knee", "l_ankle", "r_thigh", "r_knee", "r_ankle"})
        if (!column.contains(name)) fail(std::string("no column ") + name);
      continue;
    }
    const auto value = [&](const std::string& name) {
      const std::size_t c = column.find(name)->second;
      float v = 0.0f;
      if (c >= cells.size()) fail("too few columns");
      const auto [stop, error] =
          std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), v);
      if (error != std::errc{} || stop != cells[c].data() + cells[c].size() ||
          !(std::abs(v) < 1e5f))
        fail("'" + std::string(cells[c].substr(0, 40)) + "' is no sensible number");
      return v;
    };
    last_s = value("time_s");
    if (m.frames.empty()) first_s = last_s;
    MotionFrame frame;
    frame.pelvis = {0, thigh_m + shank_m + 0.066f, 0};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string p = i == 0 ? "l_" : "r_";
      const float thigh = value(p + "thigh"), knee = value(p + "knee"), ankle = value(p + "ankle");
      MotionFrame::Side& leg = frame.side[i];
      leg.hip = frame.pelvis + Vec3{i == 0 ? 0.096f : -0.096f, 0, 0};
      leg.knee = leg.hip + swung(thigh, thigh_m);
      leg.ankle = leg.knee + swung(thigh - knee, shank_m);
      leg.toe = leg.ankle + swung(90.0f + thigh - knee + ankle - 17.0f, 0.157f);
    }
    m.frames.push_back(frame);
  }
  if (m.frames.size() < 2 || !(last_s > first_s)) fail("fewer than two frames in time order");
  m.fps = static_cast<float>(m.frames.size() - 1) / (last_s - first_s);
  return m;
}

}  // namespace caryatid::bake
