#pragma once
#include <string>

#include "core/body/gait_style.h"

namespace caryatid::tool {

// The style that --mood names: a mood, "run", or "ACTIVATION,EVALUATION" from -1 to 1. Throws on
// others.
body::GaitStyle style_named(const std::string& name);

}  // namespace caryatid::tool
