#pragma once
#include <span>

#include "core/base/status.h"
#include "core/base/vec.h"
#include "core/body/bap.h"
#include "core/body/bap_axes.h"
#include "core/body/hanim.h"

namespace caryatid::body {

// Turns one frame of BAPs into joint transforms.
//
// out[j] takes a point from rest space to posed model space when it moves with joint j:
// M_j = M_parent T(c_j) R_j T(-c_j), root M = T(translation) T(c_0) R_0 T(-c_0). A skinned vertex
// is the weighted sum of out[j].point(rest). Indices are HanimJoint.
// Values: every entry of baps->value counts, whatever the mask says (absent parameters hold their
// last value). What is not finite counts as 0; angles are cut at +-1e4 rad, translations at +-1 km,
// so no stream can make the result anything but finite.
// Cost: O(joints), about 1 microsecond a frame on a PC; joints without rotation cost a copy.
// Ownership: borrows everything; nothing is kept. Threads: safe on different outputs.
struct PoseJob {
  const Skeleton* skeleton = nullptr;  // Required.
  const BapFrame* baps = nullptr;      // Required.
  BapConvention convention = BapConvention::signed_axes;
  // Empty, or kHanimJointCount unit quaternions applied inside the BAP rotation of each joint:
  // eyes, jaw and the head turn of FAP 48..50.
  std::span<const Quat> extra = {};
  std::span<Affine> out = {};  // At least kHanimJointCount long.

  // invalid_argument: a required pointer is null, or `extra` has another length.
  // out_of_capacity: `out` is too short.
  Status validate() const;
  // Validates, then poses. On error `out` is unchanged.
  Status run() const;
};

// Where the centre of a joint is in a pose.
inline Vec3 joint_position(const Skeleton& skeleton, std::span<const Affine> pose,
                           HanimJoint joint) {
  return pose[index_of(joint)].point(skeleton.center(joint));
}

}  // namespace caryatid::body
