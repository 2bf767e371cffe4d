#pragma once
// Typed access to a pack image. Borrowed bytes; everything is checked by Loader before it is used.
#include <span>

#include "core/base/limits.h"
#include "core/pack/pack.h"

namespace caryatid::pack {

// Spans over the sections of one image. Plain data, cheap to copy; valid while the image lives.
struct View {
  const Character* character = nullptr;
  std::span<const Joint> joints;
  std::span<const Material> materials;
  std::span<const Texture> textures;
  std::span<const std::byte> texels;
  std::span<const Object> objects;
  std::span<const Vertex> versions;
  std::span<const std::uint16_t> base_indices;
  std::span<const Split> splits;
  std::span<const std::uint16_t> split_data;
  std::span<const Channel> channels;
  std::span<const std::uint32_t> fat_first;  // versions.size() + 1 long.
  std::span<const Move> fat_moves;
  std::span<const FeaturePoint> feature_points;
  std::span<const float> rest_face;  // 69 long.
  std::span<const char> licences;
  std::span<const FitRule> fit;  // Empty: face::default_fit().
};

// Object with this name, or kNoObject. O(objects).
std::uint16_t find_object(const View& view, const char* name);
// Feature point "group.index", or nullptr. O(feature points).
const FeaturePoint* find_feature_point(const View& view, int group, int index);

}  // namespace caryatid::pack
