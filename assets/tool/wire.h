#pragma once
// The live meshes of a posed person as a wireframe with hidden lines removed, drawn without a GPU.
#include "assets/tool/picture.h"
#include "core/agent/person.h"
#include "core/scene/draw_list.h"

namespace caryatid::tool {

// What `camera` sees of `person` as last shown. Clear corneas are left out. O(triangles + pixels).
Picture wire_picture(const agent::Person& person, const scene::Camera& camera, std::uint32_t width,
                     std::uint32_t height);

}  // namespace caryatid::tool
