#pragma once
// The soles of a pack's person as its skinned vertices have them.
#include <vector>

#include "assets/bake/gait/measure.h"
#include "core/agent/person.h"

namespace caryatid::tool {

// Every live vertex within 35 mm of the floor at rest, of all objects.
std::vector<bake::SolePoint> skinned_soles(const agent::Person& person);

}  // namespace caryatid::tool
