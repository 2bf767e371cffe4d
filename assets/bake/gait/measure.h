#pragma once
// Measures a walk from the points of the soles as the pose moves them: not from what was intended.
#include <span>
#include <string>
#include <vector>

#include "core/body/bap.h"
#include "core/body/hanim.h"

namespace caryatid::bake {

// A point that moves with weighted joints, in rest space: of the sole outline, or a skinned vertex.
struct SolePoint {
  Vec3 rest_m{0};
  bool left = true;
  struct Share {
    body::HanimJoint joint = body::HanimJoint::count;
    float weight = 0.0f;
  };
  std::vector<Share> shares;
};

// The ten points of the skeleton's own sole outlines.
std::vector<SolePoint> outline_points(const body::Skeleton& skeleton);

struct WalkMeasures {
  float slide_m = 0.0f;        // Largest move over the floor of a standing point in one frame.
  float below_floor_m = 0.0f;  // Deepest point.
  float clearance_m = 1e9f;    // Least height of a foot's lowest point in the middle of its swing.
  float pelvis_travel_m = 0.0f;            // Vertical, of the root joint.
  int fewest_maxima = 0, most_maxima = 0;  // Of that height, from one landing to the next.
  float speed_mps = 0.0f;
  float step_m = 0.0f;  // Distance between successive landings.
  int steps = 0;
};

// `frames` at `fps`. A point stands when it is within 2 mm of the floor in two successive frames.
WalkMeasures measure_walk(const body::Skeleton& skeleton, std::span<const body::BapFrame> frames,
                          float fps, std::span<const SolePoint> soles);

// How the line from the other hip to this one rises and leads, degrees.
struct PelvisTurn {
  float list = 0.0f, rotation = 0.0f;
};
PelvisTurn pelvis_turn(Vec3 hip, Vec3 other_hip, Vec3 ahead);

// Anatomical curves of one leg from joint centres, degrees: thigh against the vertical in the
// direction of walking, knee flexion, ankle dorsiflexion (0 where the rest pose has it).
struct LegAngles {
  float thigh = 0.0f, knee = 0.0f, ankle = 0.0f, foot_pitch = 0.0f;
  float list = 0.0f, rotation = 0.0f;  // Pelvis: side of the leg up, forward.
};
LegAngles leg_angles(const body::Skeleton& skeleton, const body::BapFrame& frame, bool left);

}  // namespace caryatid::bake
