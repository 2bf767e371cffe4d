#pragma once
#include "assets/tool/studio.h"
#include "core/body/gait_style.h"

namespace caryatid::tool {

struct GaitCells {
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
};

// The four key poses of every mood on this body, from the side with the floor line: figures 5-7 and
// 5-9 of the thesis. Prints what was measured on the skinned soles of each walk.
GaitCells gait_poses(Studio* studio);
// 16 frames of one walk, from the side (8 a row) and then from the front.
GaitCells gait_strip(Studio* studio, const body::GaitStyle& style);

}  // namespace caryatid::tool
