#pragma once
// A foreign OBJ and its points, turned, scaled and set where a head belongs: metres, frame of
// core/base/vec.h. What other programs leave unsaid (unit, axes, which part is what) is found from
// the feature points.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "assets/bake/head/points_file.h"
#include "assets/bake/head/surface_graph.h"
#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bake::foreign {

// A connected part of the OBJ that is not the skin.
struct LoosePart {
  std::vector<Vec3> position_m;
  Triangles triangles;
  Vec3 low_m{0}, high_m{0};  // Its box.
  Vec3 center_m() const { return 0.5f * (low_m + high_m); }
};

struct PlacedHead {
  // The skin: the connected part on which the face's points lie.
  std::vector<Vec3> position_m;
  Triangles triangles;  // Counter-clockwise seen from outside.
  std::vector<LoosePart> parts;

  // Points on the skin, and the place of every given point. 3.5 and 3.6 are not on the skin.
  std::map<PointId, std::uint32_t> vertex;
  std::map<PointId, Vec3> place_m;

  float eye_separation_m = 0;
  std::vector<std::string> notes;  // What was found, a line each, for the bake's report.

  Vec3 at(int group, int index) const { return position_m[vertex.at({group, index})]; }
  // Midway between the lids' middles: before the eyes.
  Vec3 lids_m() const { return 0.25f * (at(3, 1) + at(3, 2) + at(3, 3) + at(3, 4)); }
  // From the height of the eyes down to the chin.
  float eyes_to_chin_m() const { return lids_m().y - at(2, 1).y; }
};

// The points without which no face can be animated: chin, lips, lids, brows, nose.
std::span<const PointId> required_points();

// Distance between the pupils that the head gets: mean of the women's and men's means of ANSUR II.
inline constexpr float kPupilDistance_m = 0.0629f;

// Throws std::runtime_error "FILE:LINE: what; cure" when a required point is missing or lies where
// none can be. O(n log n).
PlacedHead place_head(const Surface& surface, const PointList& points);

}  // namespace caryatid::bake::foreign
