#pragma once
// A head as the builders of the FAT see it: its skin, its MPEG-4 feature points, its FAPU, and the
// parts that move as one (lids, lips, jaw), found once. Metres, frame of core/base/vec.h.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "assets/bake/face/skin.h"
#include "assets/bake/human/makehuman.h"
#include "assets/bake/model.h"
#include "core/face/transforms.h"

namespace caryatid::bake::fat {

inline constexpr int kSides = 2;  // 0 is the figure's left (+X), 1 its right.

// +1 on the left, -1 on the right: the outward direction along X.
inline float outward(int side) { return side == 0 ? 1.0f : -1.0f; }

struct Eye {
  Vec3 center_m{0};
  float ball_radius_m = 0;           // Of the eye object, cornea included.
  std::vector<std::uint32_t> rim;    // Closed ring of the lid edges.
  std::vector<std::uint32_t> upper;  // Rim vertices between the corners; corners in neither.
  std::vector<std::uint32_t> lower;
  std::vector<bool> inside;  // By skin vertex: behind the lids (conjunctiva, socket).
};

// Half of the mouth as a grid of edge rings around it: row 0 lies in the skin around the lips, the
// last row deep in the vestibule. Column 0 is the upper mid-line, kLipCorner the corner of the
// mouth, kLipColumns - 1 the lower mid-line.
inline constexpr std::size_t kLipColumns = 20, kLipCorner = 10;
using LipRow = std::array<std::uint32_t, kLipColumns>;
struct Lips {
  std::vector<LipRow> row;
  // Rows on which the feature points lie: inner contour (2.2, 2.3), outer contour (8.1, 8.2).
  std::size_t upper_inner = 0, lower_inner = 0, upper_outer = 0, lower_outer = 0;
};

struct Head {
  Skin skin;
  std::vector<Vec3> normal;     // By skin vertex.
  std::vector<float> mandible;  // By skin vertex: share of the jaw's motion, 0..1.
  // By skin vertex: borders on another object, where a change of place or shading would show.
  std::vector<bool> border;
  pack::Character facts{};
  face::TransformGeometry transforms;
  std::array<Eye, kSides> eye;
  std::array<Lips, kSides> lips;

  // Feature points on the skin, by skin vertex, and all of them by place.
  std::map<std::pair<int, int>, std::uint32_t> point_vertex;
  std::map<std::pair<int, int>, Vec3> point_m;

  float middle_x_m = 0;  // Where the face's mid-line lies.
  // Distance from the mid-line, positive towards the side.
  float lateral(Vec3 p, int side) const { return (p.x - middle_x_m) * outward(side); }

  // Both throw std::runtime_error naming the point when the character lacks it.
  std::uint32_t vertex_of(int group, int index) const;
  Vec3 place_of(int group, int index) const;
};

// Height of the line through a brow's three feature points at the lateral place of p.
float brow_line_m(const Head& head, int side, Vec3 p);

// Rim, lids and socket of one eye of the base human's skin; centre and radius are left to the
// caller.
Eye find_eye(const Skin& skin, const BaseHuman& base, int side);

// Throws std::runtime_error when the head is not the base human's, or lacks what the FAT needs.
Head make_head(const Character& character, const BaseHuman& base);

}  // namespace caryatid::bake::fat
