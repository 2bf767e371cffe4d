#pragma once
// Analytic inverse kinematics of two-bone chains (leg, arm), in closed form: shoulder or hip with
// three degrees of freedom, a hinge about the lateral axis, and the place of ankle or wrist given.
#include "core/body/bap_axes.h"
#include "core/body/hanim.h"

namespace caryatid::body {

struct Limb {
  HanimJoint upper, hinge, end;
  float bend;           // +1 where the hinge flexes about +X (knee), -1 about -X (elbow).
  float hinge_max_rad;  // Table 4-1 of the thesis: knee 113, elbow 142 degrees.
};
const Limb& leg(bool left);
const Limb& arm(bool left);

struct LimbTarget {
  Vec3 reach_m{0};           // From the upper joint to the wanted end, in the frame of its parent.
  Vec3 hinge_axis{1, 0, 0};  // Where the hinge's +X axis should point, same frame: which way knee
                             // or elbow bends. Its part along `reach_m` does not count.
};

struct LimbPose {
  Mat3 upper{1.0f};          // Rotation of the upper joint in its parent's frame.
  float hinge_rad = 0.0f;    // Rotation of the hinge about +X, from the rest pose.
  float flexion_rad = 0.0f;  // Angle between the two bones, 0 when straight.
  float missed_m = 0.0f;     // Distance by which the target lies out of reach; 0 when it is met.
};

// Bends the limb so that its end meets the target; when that is nearer or farther than the limb
// allows, it points there as far as it can. Defined for every finite input.
LimbPose solve_limb(const Skeleton& skeleton, const Limb& limb, const LimbTarget& target);

// Rest lengths of a limb's two bones.
float upper_length(const Skeleton& skeleton, const Limb& limb);
float lower_length(const Skeleton& skeleton, const Limb& limb);

// A rotation as R = Rx(x) Rz(z) Ry(y), the order of the BAPs of hips, knees, ankles and shoulders.
struct EulerXzy {
  float x = 0.0f, z = 0.0f, y = 0.0f;
};
EulerXzy euler_xzy(const Mat3& r);
Mat3 rotation_x(float rad);
Mat3 rotation_y(float rad);
Mat3 rotation_z(float rad);

// Sets the BAP of `joint` that turns about `axis` so that it turns by `rad` about the positive
// axis. Nothing happens when the joint has no such BAP.
void set_turn(BapFrame& frame, HanimJoint joint, Axis axis, float rad);
// What set_turn would have been called with.
float get_turn(const BapFrame& frame, HanimJoint joint, Axis axis);
// The number of that BAP, 0 when there is none.
int turn_bap(HanimJoint joint, Axis axis);

}  // namespace caryatid::body
