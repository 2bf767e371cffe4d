#include "assets/tool/gait_sheet.h"

#include <cstdio>

#include "assets/tool/soles.h"
#include "core/body/walker.h"

namespace caryatid::tool {
namespace {

// A walk that has settled, from a heel strike of the right foot; steps of a share of the cycle.
class SettledWalk {
 public:
  SettledWalk(const body::Skeleton& skeleton, const body::GaitStyle& style) : walker_(&skeleton) {
    walker_.set_style(style);
    walker_.walk_to({0, 1e4f});
    for (int i = 0; i < 300; ++i) walker_.step(1.0f / 30.0f, frame_);
    to_phase(0.49f);
    to_phase(0.5f);
  }
  // Until the left leg has reached this share of its cycle.
  const body::BapFrame& to_phase(float left_phase) {
    for (int i = 0; i < 4000; ++i) {
      const float before = walker_.left_phase();
      walker_.step(1.0f / 960.0f, frame_);
      const float now = walker_.left_phase();
      if (now >= before ? before < left_phase && now >= left_phase
                        : left_phase > before || left_phase <= now)
        break;
    }
    return frame_;
  }
  std::vector<body::BapFrame> record(int count, float fps) {
    std::vector<body::BapFrame> frames;
    for (int i = 0; i < count; ++i) {
      walker_.step(1.0f / fps, frame_);
      frames.push_back(frame_);
    }
    return frames;
  }

 private:
  body::Walker walker_;
  body::BapFrame frame_;
};

// The figure without its travel, the whole body in the picture.
Picture figure(Studio* studio, body::BapFrame frame, bool side) {
  frame.set(182, 0.0f);
  frame.set(183, 0.0f);
  Pose pose;
  pose.baps = frame;
  const float stature = studio->person().view().character->stature_m;
  scene::Framing framing;
  framing.target_m = {0.0f, 0.5f * stature, 0.0f};
  framing.direction = side ? Vec3{-1, 0, 0} : Vec3{0, 0, 1};
  framing.visible_height_m = 1.12f * stature;
  framing.visible_width_m = 0.6f * stature;
  pose.framing = framing;
  return studio->picture(pose);
}

}  // namespace

GaitCells gait_poses(Studio* studio) {
  constexpr const char* kPoses[] = {"extended", "recoil", "passing", "anticipation"};
  (void)studio->picture({});  // Brings the person to full detail.
  const body::Skeleton& skeleton = studio->person().skeleton();
  const auto soles = skinned_soles(studio->person());
  GaitCells cells;
  for (int m = 0; m < body::kGaitMoodCount; ++m) {
    const char* name = body::gait_mood_name(body::GaitMood(m));
    SettledWalk walk(skeleton, body::gait_style(body::GaitMood(m)));
    for (int p = 0; p < 4; ++p) {
      // The right leg stands: its phase is the left one's and a half.
      const float phase = 0.5f + 0.125f * static_cast<float>(p);
      cells.pictures.push_back(
          figure(studio, p == 0 ? walk.to_phase(0.502f) : walk.to_phase(phase), true));
      cells.captions.push_back(std::string(name) + ", " + kPoses[p]);
    }
    const auto w = bake::measure_walk(skeleton, walk.record(300, 30.0f), 30.0f, soles);
    std::printf(
        "%-8s slide %.2f mm a frame, below floor %.2f mm, clearance %.1f mm, pelvis travel "
        "%.1f mm, %d maxima in %d steps, %.2f m/s\n",
        name, 1e3 * double(w.slide_m), 1e3 * double(w.below_floor_m), 1e3 * double(w.clearance_m),
        1e3 * double(w.pelvis_travel_m), w.maxima, w.steps, double(w.speed_mps));
  }
  return cells;
}

GaitCells gait_strip(Studio* studio, const body::GaitStyle& style) {
  GaitCells cells;
  for (const bool side : {true, false}) {
    SettledWalk walk(studio->person().skeleton(), style);
    for (int i = 0; i < 16; ++i) {
      float phase = 0.5f + static_cast<float>(i) / 16.0f + 0.002f;
      if (phase >= 1.0f) phase -= 1.0f;
      cells.pictures.push_back(figure(studio, walk.to_phase(phase), side));
      cells.captions.push_back(std::to_string(i));
    }
  }
  return cells;
}

}  // namespace caryatid::tool
