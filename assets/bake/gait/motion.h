#pragma once
// What the analysis of a gait needs of any source: where the joints of the legs, the trunk and the
// arms are in every frame.
#include <array>
#include <span>
#include <vector>

#include "assets/bake/gait/bvh.h"
#include "core/body/bap.h"
#include "core/body/bap_axes.h"
#include "core/body/hanim.h"

namespace caryatid::bake {

struct MotionFrame {
  Vec3 pelvis{0}, neck{0}, head{0};
  struct Side {
    Vec3 hip{0}, knee{0}, ankle{0}, toe{0}, shoulder{0}, elbow{0}, wrist{0};
  };
  std::array<Side, 2> side;  // [0] left, [1] right.
};

struct Motion {
  float fps = 30.0f;
  bool has_arms = false, has_trunk = false;
  std::vector<MotionFrame> frames;
};

// Throws std::runtime_error when the legs cannot be found by the usual names.
Motion motion_of(const Bvh& bvh);
Motion motion_of(const body::Skeleton& skeleton, std::span<const body::BapFrame> frames, float fps,
                 body::BapConvention convention = body::BapConvention::signed_axes);
// Angle curves as text: a header naming the columns time_s, l_thigh, l_knee, l_ankle, r_thigh,
// r_knee, r_ankle (degrees, any order, others ignored), then one line a frame; legs of our generic
// body. Throws std::runtime_error "FILE:LINE: ...".
Motion motion_of_csv(std::string_view text, const std::string& file_name);

}  // namespace caryatid::bake
