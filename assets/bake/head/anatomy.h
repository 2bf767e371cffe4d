#pragma once
// What a foreign head does not say, from the proportions of people: joints, the share of the jaw,
// points that were left out.
#include "assets/bake/head/openings.h"
#include "core/body/hanim.h"

namespace caryatid::bake::foreign {

// Joints of neck and head, parents first, in the order of Character::joints.
std::vector<Joint> head_joints(const PlacedHead& head, const Openings& openings);
std::uint16_t joint_index(const std::vector<Joint>& joints, body::HanimJoint joint);

// How skin below the skull hangs on the vertebrae of the neck.
Influence neck_influence(const std::vector<Joint>& joints, Vec3 position_m);

// Share of the mandible's motion of every skin vertex: all below the line from the jaw's hinge to
// the corners of the mouth, less and less towards hinge and throat.
std::vector<float> mandible_share(const PlacedHead& head, Vec3 hinge_m);

// Adds 2.10, cheeks (5.1-5.4) and pupils' places when they were not given.
void derive_points(const Openings& openings, PlacedHead& head);

}  // namespace caryatid::bake::foreign
