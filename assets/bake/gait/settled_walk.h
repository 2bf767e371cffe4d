#pragma once
// A walk in its stride: what every sheet, strip, plot and measure of a gait looks at.
#include <vector>

#include "core/body/walker.h"

namespace caryatid::bake {

// Straight along +Z, settled, from a heel strike of the right foot on.
class SettledWalk {
 public:
  // Borrows the skeleton.
  SettledWalk(const body::Skeleton& skeleton, const body::GaitStyle& style,
              body::GaitInterpolation interpolation = body::GaitInterpolation::smooth);

  // Walks on until the left leg has reached this share (0..1) of its cycle.
  const body::BapFrame& to_phase(float left_phase);
  const body::BapFrame& step(float dt_s);
  // The present frame and what follows.
  std::vector<body::BapFrame> record(int count, float fps);

 private:
  body::Walker walker_;
  body::BapFrame frame_;
};

}  // namespace caryatid::bake
