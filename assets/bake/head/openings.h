#pragma once
// Eyes and mouth of a foreign head: finds lid rims and lip contours as chains of vertices, cuts
// open what is modelled shut or filled, and gives openings of a mere mask a lining.
#include "assets/bake/face/head.h"
#include "assets/bake/head/placed_head.h"

namespace caryatid::bake::foreign {

// What a skin vertex is part of.
enum class Zone : std::uint8_t { face, socket, mouth };

struct Openings {
  std::array<fat::Eye, fat::kSides> eye;
  std::array<bool, fat::kSides> own_ball{};     // The OBJ has an eyeball there, as a loose part:
  std::array<std::size_t, fat::kSides> ball{};  // this one of PlacedHead::parts.
  std::array<fat::Lips, fat::kSides> lips;
  std::vector<Zone> zone;  // By skin vertex.
};

// Changes the skin: cuts, linings, and a vertex more on a lip that had none between its middle and
// its corner. Adds the quarter points of the lips when they were not given. Throws
// std::runtime_error naming the points between which there is no way along the skin.
Openings open_head(const PointList& points, PlacedHead& head);

}  // namespace caryatid::bake::foreign
