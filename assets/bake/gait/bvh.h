#pragma once
// Reads BVH motion capture files (Biovision hierarchy), any order of rotation channels.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vec.h"

namespace caryatid::bake {

struct BvhJoint {
  std::string name;  // "" for end sites.
  int parent = -1;
  Vec3 offset{0};
  struct Channel {
    bool rotation = false;
    int axis = 0;  // 0 x, 1 y, 2 z
  };
  std::vector<Channel> channels;
  std::size_t first_channel = 0;
};

struct Bvh {
  std::vector<BvhJoint> joints;  // Parents first.
  float frame_s = 0.0f;
  std::size_t frame_count = 0, channel_count = 0;
  std::vector<float> values;  // frame_count * channel_count, degrees and file units.

  // Positions of all joints in one frame, file units.
  std::vector<Vec3> positions(std::size_t frame) const;
  // Index of the first of these names that a joint has, ignoring case and a "prefix:"; -1: none.
  int find(std::initializer_list<std::string_view> names) const;
};

// Throws std::runtime_error "FILE:LINE: what; cure" for anything that is not whole and sane: at
// most 512 joints, 64 deep, a million values, frame times of 1 ms to 1 s, finite numbers.
Bvh read_bvh(std::string_view text, const std::string& file_name);

}  // namespace caryatid::bake
