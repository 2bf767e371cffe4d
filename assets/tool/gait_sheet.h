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
// One walk in one picture, nothing in it naming the style: its pace in numbers; a chronophotograph
// over 4.2 s, figures at the distance they have walked, over a rule of metres; 16 frames of the
// cycle from the side and from the front.
Picture gait_strip(Studio* studio, const body::GaitStyle& style);

}  // namespace caryatid::tool
