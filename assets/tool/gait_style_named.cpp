#include "assets/tool/gait_style_named.h"

#include <algorithm>

#include "assets/tool/command_line.h"
#include "assets/tool/numbers.h"

namespace caryatid::tool {

body::GaitStyle style_named(const std::string& name) {
  if (name == "run") return body::running_style();
  for (int m = 0; m < body::kGaitMoodCount; ++m)
    if (name == body::gait_mood_name(body::GaitMood(m))) return body::gait_style(body::GaitMood(m));
  const std::size_t comma = std::min(name.find(','), name.size());
  const auto activation = number_within(name.substr(0, comma), -1, 1);
  const auto evaluation = number_within(name.substr(std::min(comma + 1, name.size())), -1, 1);
  if (activation && evaluation)
    return body::gait_style_at(static_cast<float>(*activation), static_cast<float>(*evaluation));
  throw UsageError("--mood: no mood '" + name +
                   "'; normal bored happy sad angry hurried tired proud run, or "
                   "ACTIVATION,EVALUATION from -1 to 1");
}

}  // namespace caryatid::tool
