#pragma once
#include "assets/tool/gait_sheet.h"

namespace caryatid::tool {

// Every gesture at its height: standing from the front and from beside, and over the walk.
GaitCells gesture_poses(Studio* studio);

}  // namespace caryatid::tool
