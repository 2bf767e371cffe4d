#include "assets/tool/gait_style_named.h"

#include <cstdio>
#include <stdexcept>

namespace caryatid::tool {

body::GaitStyle style_named(const std::string& name) {
  if (name == "run") return body::running_style();
  for (int m = 0; m < body::kGaitMoodCount; ++m)
    if (name == body::gait_mood_name(body::GaitMood(m))) return body::gait_style(body::GaitMood(m));
  float activation = 0.0f, evaluation = 0.0f;
  char rest = 0;
  if (std::sscanf(name.c_str(), "%f,%f%c", &activation, &evaluation, &rest) == 2)
    return body::gait_style_at(activation, evaluation);
  throw std::runtime_error("--mood: no mood '" + name +
                           "'; normal bored happy sad angry hurried tired proud run, or "
                           "ACTIVATION,EVALUATION from -1 to 1");
}

}  // namespace caryatid::tool
