// Where parts of the mouth and the eyes touch, measured on the deformed meshes of both characters.
#include <algorithm>
#include <cmath>

#include "core/face/fap_table.h"
#include "core/face/visemes.h"
#include "tests/unit/bake/face/baked.h"

namespace caryatid::bake {
namespace {

using face::FapFrame;
using fat::kLipColumns;
using fat::kLipCorner;

class Contact : public OnBothFaces {
 protected:
  // Edges of the two middle incisors: the lowest (highest) vertices near the mid-line in front.
  std::vector<Vec3> incisor_edges(const PosedFace& face, bool upper) const {
    const auto& teeth = face.object(upper ? "upper_teeth" : "lower_teeth");
    const Vec3 edge = face.point(9, upper ? 10 : 11);
    std::vector<Vec3> out;
    for (const Vec3 p : teeth)
      if (std::abs(p.x - head().middle_x_m) < 0.006f && std::abs(p.y - edge.y) < 0.0008f &&
          std::abs(p.z - edge.z) < 0.003f)
        out.push_back(p);
    return out;
  }

  // Closest that points come to a lip: its grid of quads, from the outer contour to the wet side.
  float distance_to_lip(const PosedFace& face, const std::vector<Vec3>& points, bool upper) const {
    float least = 1e9f;
    for (const fat::Lips& lips : head().lips) {
      const std::size_t inner = upper ? lips.upper_inner : lips.lower_inner;
      const std::size_t first = upper ? 0 : kLipCorner + 1;
      const std::size_t last = upper ? kLipCorner : kLipColumns - 1;
      for (std::size_t r = inner - 3; r < inner + 3; ++r)
        for (std::size_t c = first; c < last; ++c)
          for (int i = 0; i <= 8; ++i)
            for (int j = 0; j <= 8; ++j) {
              const float u = static_cast<float>(i) / 8, w = static_cast<float>(j) / 8;
              const Vec3 p = glm::mix(
                  glm::mix(face.skin_m[lips.row[r][c]], face.skin_m[lips.row[r][c + 1]], u),
                  glm::mix(face.skin_m[lips.row[r + 1][c]], face.skin_m[lips.row[r + 1][c + 1]], u),
                  w);
              for (const Vec3 q : points) least = std::min(least, glm::length(p - q));
            }
    }
    return least;
  }
};

TEST_P(Contact, BilabialsShutTheLips) {
  const PosedFace face = posed(face::viseme_frame(1));
  for (const float gap : gaps(face)) {
    EXPECT_LE(gap, 3e-4f);
    EXPECT_GE(gap, -1e-3f) << "pressed lips meet, they do not cross";
  }
}

TEST_P(Contact, LabiodentalsBringTheLowerLipToTheUpperTeeth) {
  const PosedFace face = posed(face::viseme_frame(2));
  EXPECT_LE(distance_to_lip(face, incisor_edges(face, true), false), 1e-3f);
}

TEST_P(Contact, TheTongueComesBetweenTheTeeth) {
  const PosedFace face = posed(face::viseme_frame(3));
  const Vec3 tip = face.point(6, 1), upper = face.point(9, 10), lower = face.point(9, 11);
  EXPECT_GT(tip.z, upper.z) << "it shows";
  EXPECT_LT(tip.y, upper.y + 5e-4f);
  EXPECT_GT(tip.y, lower.y - 5e-4f);
}

TEST_P(Contact, TheTongueTouchesTheUpperTeeth) {
  for (const int viseme : {4, 8}) {
    const PosedFace face = posed(face::viseme_frame(viseme));
    const Vec3 tip = face.point(6, 1);
    float least = 1e9f;
    for (const Vec3 p : face.object("upper_teeth")) least = std::min(least, glm::length(p - tip));
    EXPECT_LT(least, 2e-3f) << viseme;
  }
}

INSTANTIATE_TEST_SUITE_P(Characters, Contact, testing::Values(std::size_t{0}, std::size_t{1}),
                         character_name);

}  // namespace
}  // namespace caryatid::bake
