#include "assets/tool/gesture_sheet.h"

#include "assets/tool/progress.h"
#include "core/body/gesture.h"
#include "core/body/walker.h"

namespace caryatid::tool {
namespace {

body::BapFrame at_its_height(const body::Skeleton& skeleton, body::GestureKind kind, bool walking) {
  constexpr float kStep_s = 1.0f / 60.0f;
  body::Walker walker(&skeleton);
  body::GestureLayer layer;
  body::BapFrame frame;
  if (walking) walker.walk_to({0, 1e4f});
  for (int i = 0; i < 240; ++i) walker.step(kStep_s, frame);
  const Vec3 ahead{0.0f, 0.0f, walker.place().y};
  layer.start({.kind = kind, .target_m = ahead + Vec3{-1.0f, 1.6f, 1.2f}});
  const int frames = kind == body::GestureKind::nod ? 16 : 42;
  for (int i = 0; i < frames; ++i) {
    walker.step(kStep_s, frame);
    layer.step(kStep_s);
  }
  layer.apply(skeleton, frame);
  frame.set(182, 0.0f);
  frame.set(183, 0.0f);
  return frame;
}

}  // namespace

GaitCells gesture_poses(Studio* studio) {
  const float stature = studio->person().view().character->stature_m;
  const body::Skeleton& skeleton = studio->person().skeleton();
  struct Look {
    const char* name;
    bool walking;
    Vec3 from;
  };
  constexpr Look kLooks[] = {{"", false, {0, 0, 1}},
                             {", from her right", false, {-0.94f, 0, 0.34f}},
                             {" while walking", true, {0, 0, 1}},
                             {" while walking, from behind", true, {0.5f, 0, -0.87f}}};
  GaitCells cells;
  Progress progress;
  for (int k = 1; k <= static_cast<int>(body::GestureKind::beat); ++k)
    for (const Look& look : kLooks) {
      const auto kind = static_cast<body::GestureKind>(k);
      progress.step(std::string("gesture ") + body::gesture_name(kind) + look.name);
      Pose pose;
      pose.baps = at_its_height(skeleton, kind, look.walking);
      scene::Framing framing;
      framing.target_m = {0.0f, 0.55f * stature, 0.0f};
      framing.direction = look.from;
      framing.visible_height_m = 1.2f * stature;
      framing.visible_width_m = 0.6f * stature;
      pose.framing = framing;
      cells.pictures.push_back(studio->picture(pose));
      cells.captions.push_back(std::string(body::gesture_name(kind)) + look.name);
    }
  return cells;
}

}  // namespace caryatid::tool
