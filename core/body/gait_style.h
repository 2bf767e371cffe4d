#pragma once
// The character of a walk: the four key poses of the thesis (5.3) and the bearing above them.
#include <array>
#include <cstdint>

#include "core/base/vec.h"

namespace caryatid::body {

// Key poses of the first half cycle: extended 0 %, recoil 12.5 %, passing 25 %, anticipation
// 37.5 % (frames 0, 4, 8, 12 of 32). "Stance" is the leg in front at 0 %, "swing" the other; the
// second half is the first with legs exchanged.
inline constexpr int kGaitKeys = 4;
using GaitKeys = std::array<float, kGaitKeys>;

// Everything is float and blends linearly. Angles are anatomical: thigh against the vertical,
// forward +; knee flexion +; ankle dorsiflexion +; pitches forward or down +.
struct GaitStyle {
  GaitKeys list_deg{};      // Pelvis: side of the stance leg up +.
  GaitKeys rotation_deg{};  // Pelvis: side of the stance leg forward +.
  GaitKeys stance_thigh_deg{}, stance_knee_deg{}, stance_ankle_deg{};
  GaitKeys swing_thigh_deg{}, swing_knee_deg{}, swing_ankle_deg{};
  float cycle_s = 1.0f;  // Of two steps.
  float trunk_pitch_deg = 0.0f;
  float head_pitch_deg = 0.0f;    // Against the vertical, not the trunk.
  float head_forward_deg = 0.0f;  // Lower neck forward, upper back: the head thrust out.
  // Upper arm against the vertical at the extended pose.
  float arm_forward_deg = 0.0f, arm_back_deg = 0.0f;
  float elbow_forward_deg = 0.0f, elbow_back_deg = 0.0f;  // Elbow flexion at the same moments.
  float shoulder_turn_deg = 0.0f;                         // Shoulders against the pelvis.
  float head_roll_deg = 0.0f;                             // Swings once in a cycle.
  float trunk_roll_deg = 0.0f;                            // Towards the stance side.
  float chest_pitch_deg = 0.0f;                           // Upper back: bowed +, chest out -.
  float shoulders_forward_deg = 0.0f, shoulders_up_deg = 0.0f;
  float arm_out_deg = 0.0f;
  float finger_curl_deg = 0.0f;  // Of each joint: 15 hangs relaxed, 75 is a fist.
  float bounce_m = 0.0f;         // Heel rise of the standing foot about passing.
  float contact = 0.62f;       // Share of the cycle that a foot is on the floor; below 0.5: a run.
  float step_width_m = 0.10f;  // Between the ankles, for a leg of 0.927 m.
  float sway_m = 0.02f;        // Of the pelvis to each side.
  float toe_out_deg = 6.0f;
  float toe_bend_deg = 32.0f;  // How far the toes bend before they roll over their edge.
};

enum class GaitMood : std::uint8_t { normal, bored, happy, sad, angry, hurried, tired, proud };
inline constexpr int kGaitMoodCount = 8;
const char* gait_mood_name(GaitMood mood);

// The walk of one mood; constant, checked for clearance and joint limits by the tests.
const GaitStyle& gait_style(GaitMood mood);
// The run: 24 frames at 30 fps a cycle, with a flight phase.
const GaitStyle& running_style();
// Standing and marking time: the other end of every start, stop and turn on the spot.
const GaitStyle& standing_style();

// (1 - share) a + share b, field by field.
GaitStyle blend(const GaitStyle& a, const GaitStyle& b, float share);

// Any point of the activation-evaluation plane, both -1..1: a blend of the moods by their distance,
// which is exact where a mood has its place and passes through the normal walk in the middle.
GaitStyle gait_style_at(float activation, float evaluation);
// Where a mood has its place there: x activation, y evaluation.
Vec2 gait_mood_place(GaitMood mood);

}  // namespace caryatid::body
