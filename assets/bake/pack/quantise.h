#pragma once
// Floats of the bake to the small integers of the pack.
#include <span>

#include "assets/bake/simplify/object_history.h"

namespace caryatid::bake {

// `palette` lists the joints of the object in the order of pack::Object::bone. Weights are rounded
// so that they add up to 255. uv outside 0..1 is clamped.
pack::Vertex quantise(const VertexVersion& v, std::span<const std::uint16_t> palette);
// Steps of 2 um, normals in 1/127; out of range is clamped.
pack::Move quantise(const VertexVersion::ChannelMove& move);

}  // namespace caryatid::bake
