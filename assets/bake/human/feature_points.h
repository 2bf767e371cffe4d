#pragma once
// The MPEG-4 feature points of the base human and the lengths that follow from them (FAPU).
#include <filesystem>
#include <string>
#include <vector>

#include "assets/bake/human/makehuman.h"
#include "assets/bake/model.h"

namespace caryatid::bake {

// One line of assets/characters/feature_points.toml.
struct FeaturePointPlace {
  int group = 0, index = 0;
  std::uint32_t base_vertex = kNone;  // Of hm08; or
  std::string joint;                  // an H-Anim joint; or
  std::string object;                 // the vertex of this object farthest towards
  Vec3 towards{0};
  bool middle = false;  // of those within 4 mm of the middle plane.
};

// Reads the map and adds mirrored points. Throws std::runtime_error (one line) when it is wrong or
// does not name each of the 84 points once.
std::vector<FeaturePointPlace> read_feature_points(const std::filesystem::path& file,
                                                   const BaseHuman& base);
inline constexpr std::size_t kFeaturePointCount = 84;

// The vertex of hm08 on the other side of the middle plane; itself on the plane.
std::uint32_t mirrored_vertex(const BaseHuman& base, std::uint32_t vertex);

// Vertex of hm08 of a point. Throws when the map does not put it there.
std::uint32_t base_vertex_of(const std::vector<FeaturePointPlace>& places, int group, int index);

// Fills Character::feature_points and the FAPU, stature and leg length of Character::facts. Throws
// when a vertex is hidden or an object is missing; hair's thickness (11.5) falls back to 11.4.
void place_feature_points(const std::vector<FeaturePointPlace>& places, Character& character);

}  // namespace caryatid::bake
