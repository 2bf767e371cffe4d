#pragma once
// The list of feature points that comes with a foreign head: text, every byte hostile.
//
//   # comment              to the end of the line
//   count 0                vertices count from 0 in the lines that follow; without it from 1, as
//                          in an OBJ
//   3.1 1234               feature point 3.1 (ISO/IEC 14496-2 annex C) is this vertex of the OBJ
//   3.5 0.031 1.62 0.09    or stands here, in the OBJ's own unit and axes
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/bake/simplify/vec3d.h"

namespace caryatid::bake::foreign {

// Group and index: {2, 10} is "2.10".
using PointId = std::pair<int, int>;
std::string name_of(PointId id);

struct GivenPoint {
  PointId id;
  std::optional<std::uint32_t> vertex;  // From 0; not yet held against a mesh.
  Vec3d position{0};                    // When there is no vertex. Finite.
  std::size_t line = 0;
};

struct PointList {
  std::string file;  // For messages.
  std::vector<GivenPoint> points;

  const GivenPoint* find(PointId id) const;
  // Throws "FILE:LINE: what" for the line of a point; FILE alone when it has none.
  [[noreturn]] void fail(const GivenPoint* point, const std::string& what) const;
};

// Throws std::runtime_error, one line "NAME:LINE: what is wrong; what to do". O(bytes).
PointList parse_points(std::string_view text, const std::string& name);

// Does the standard know the point?
bool is_feature_point(PointId id);

}  // namespace caryatid::bake::foreign
