#pragma once
// How each rotational BAP turns its joint. The standard's figures leave signs and order open, and
// the tools of the time read them differently: each reading is a named convention here.
#include <cstdint>

#include "core/body/bap.h"
#include "core/body/hanim.h"

namespace caryatid::body {

enum class Axis : std::uint8_t { x, y, z };

// Rotations of one joint compose as intrinsic rotations in the order of their BAP numbers (the axes
// move with the limb): R = R_first * R_second * R_third, column vectors.
enum class BapConvention : std::uint8_t {
  // Flexions and tilts about -X, abductions and rolls about +Z, torsions about +Y, limb twists
  // about -Y, wrist flexion about -Z (as a widespread decoder does). The convention of this
  // project's own frames: hip flexion > 0 lifts the thigh forward, knee flexion < 0 bends the knee.
  // One departure: that decoder also flexes the fingers about -X, which spreads them where palms
  // face the thighs; here they flex about Z towards the palm (> 0 closes either hand) and pivot
  // about -X.
  signed_axes,
  // The same axes, all positive. Hand-written text files may mean this (sit.bap of the VREng
  // project, whose recorded gestures are signed_axes): there hip flexion < 0 lifts the thigh and
  // knee flexion > 0 bends the knee.
  plain_axes,
  // signed_axes with the order of rotations reversed (last BAP of the joint outermost).
  signed_axes_reversed,
};

struct BapAxis {
  HanimJoint joint;
  Axis axis;
  std::int8_t sign;  // In signed_axes.
};

inline constexpr int kFirstTranslationBap = 181;  // Vertical, lateral, frontal: 181, 182, 183 (mm).
inline constexpr int kFirstRootTurnBap = 184;     // Turn +Y, roll +Z, tilt +X.

// Axis of BAP 1..180 and 184..186. Asserts on any other number.
BapAxis bap_axis(int bap);

// The BAPs that turn a joint, in composition order; unused entries are 0.
struct JointBaps {
  std::int16_t bap[3] = {0, 0, 0};
};
JointBaps joint_baps(HanimJoint joint);

}  // namespace caryatid::body
