#pragma once
// How far a decoded stream moves the feature points of a real head from where the original has
// them.
#include <memory>
#include <string>
#include <vector>

#include "assets/bake/stream/clip_files.h"
#include "core/agent/person.h"

namespace caryatid::bake {

// The person of a pack at its base level, where every feature point lives.
class HeadMeter {
 public:
  // Throws std::runtime_error, one line.
  explicit HeadMeter(const std::string& pack_path);

  // Shows both clips frame by frame, partners filled as the kiosk does, and measures every feature
  // point of the face (groups 2..11) that the head has, in the world: turns of the head included.
  PointError measure(const std::vector<face::FapFrame>& original,
                     const std::vector<face::FapFrame>& decoded);

  // The rules by which this face completes a stream.
  std::vector<face::FitRule> fit() const { return {person_->fit().begin(), person_->fit().end()}; }

 private:
  std::vector<Vec3> points_of(const face::FapFrame& frame);

  std::vector<Vec4> image_;
  std::vector<std::byte> memory_;
  std::unique_ptr<pack::Loader> loader_;
  std::unique_ptr<agent::Person> person_;
};

}  // namespace caryatid::bake
