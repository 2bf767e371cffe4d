#include "assets/bake/gait/settled_walk.h"

namespace caryatid::bake {

SettledWalk::SettledWalk(const body::Skeleton& skeleton, const body::GaitStyle& style,
                         body::GaitInterpolation interpolation)
    : walker_(&skeleton) {
  walker_.set_style(style);
  walker_.set_interpolation(interpolation);
  walker_.walk_to({0, 1e4f});
  for (int i = 0; i < 300; ++i) walker_.step(1.0f / 30.0f, frame_);
  to_phase(0.49f);
  to_phase(0.5f);
}

const body::BapFrame& SettledWalk::to_phase(float left_phase) {
  for (int i = 0; i < 4000; ++i) {
    const float before = walker_.left_phase();
    walker_.step(1.0f / 960.0f, frame_);
    const float now = walker_.left_phase();
    const bool there = now >= before ? before < left_phase && now >= left_phase
                                     : left_phase > before || left_phase <= now;
    if (there) break;
  }
  return frame_;
}

const body::BapFrame& SettledWalk::step(float dt_s) {
  // The walker cuts a step to 0.1 s.
  for (; dt_s > 0.0f; dt_s -= 0.05f) walker_.step(dt_s < 0.05f ? dt_s : 0.05f, frame_);
  return frame_;
}

std::vector<body::BapFrame> SettledWalk::record(int count, float fps) {
  std::vector<body::BapFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(frame_);
    walker_.step(1.0f / fps, frame_);
  }
  return frames;
}

}  // namespace caryatid::bake
