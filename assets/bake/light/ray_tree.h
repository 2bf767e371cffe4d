#pragma once
// Short rays against many triangles: a bounding volume hierarchy, median split.
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace caryatid::bake {

class RayTree {
 public:
  struct Triangle {
    std::array<Vec3, 3> corner;
    float opacity = 1.0f;  // What a hit on it hides, 0..1.
  };
  struct Hit {
    float distance_m = 0.0f;
    float opacity = 0.0f;  // 0: nothing was hit.
  };

  // Builds in O(n log n); heap only here.
  explicit RayTree(std::vector<Triangle> triangles);
  // The first triangle on the way, either side of it, nearer than reach_m. direction: unit.
  Hit first_hit(Vec3 origin_m, Vec3 direction, float reach_m) const;

 private:
  struct Node {
    Vec3 low{0}, high{0};
    std::uint32_t first = 0, count = 0;  // Leaf: triangles; else count 0 and first is the right
                                         // child, the left one follows its parent.
  };
  void build(std::uint32_t first, std::uint32_t count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace caryatid::bake
