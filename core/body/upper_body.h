#pragma once
// Trunk, head, arms and hands of a walking or standing figure.
#include "core/body/bap_axes.h"
#include "core/body/gait_style.h"
#include "core/body/hanim.h"

namespace caryatid::body {

// Writes the BAPs of spine, neck, clavicles, arms and fingers for the bearing of `style`.
// `left_phase`: share of the left leg's cycle; `swing` 0..1 scales what moves with the steps;
// `slow_phase`: share of a two-cycle period, for what swings once in two. Arms go to palm targets
// in polar form about the shoulder and are solved as two-bone chains.
void pose_upper_body(const Skeleton& skeleton, const GaitStyle& style, float left_phase,
                     float slow_phase, float swing, BapFrame& out);

// Turns a region of the spine about an axis, shared evenly by its joints.
enum class SpinePart : std::uint8_t { lumbar, lower_thoracic, upper_thoracic, neck };
void turn_spine(BapFrame& out, SpinePart part, Axis axis, float rad);

// Curls the four fingers (flexion of every joint) and bends the thumb beside them.
void curl_hand(BapFrame& out, bool left, float finger_rad, float thumb_rad);

}  // namespace caryatid::body
