#pragma once
// Anthropometric landmarks of a head (names as Farkas 1994 has them; thesis chapter 6): what of the
// standard set a mesh with MPEG-4 feature points can carry. Points that are feature points are
// taken as they are; others are found on the skin where the definition puts them. Not found: po,
// ac (hidden in the ear, and a crease that the mesh does not resolve).
#include <array>
#include <map>
#include <string>
#include <vector>

#include "assets/bake/model.h"

namespace caryatid::bake::anthropometry {

struct Landmark {
  Vec3 place_m{0};
  std::string source;  // "9.3", or in words where it was found.
};

struct MeasuredHead {
  // Welded skin: each vertex once, whatever its texture seams.
  std::vector<Vec3> position_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // By name; of paired ones the left is "en l", the right "en r".
  std::map<std::string, Landmark> landmarks;
  // Turn about X (rad) that brings the head into the Frankfurt position: the line from tragion to
  // orbitale lies level. 0 when one of them is missing.
  float to_frankfurt_rad = 0;

  Vec3 in_frankfurt(Vec3 p_m) const;
};

// Any character with a head object and feature points: our own people and foreign heads. A landmark
// whose feature points are missing is left out.
MeasuredHead find_landmarks(const Character& character);

}  // namespace caryatid::bake::anthropometry
