#include "core/body/gait_style.h"

#include <bit>
#include <cassert>
#include <cstddef>

namespace caryatid::body {
namespace {

// Key poses: made for this project from the normative curves of Schwartz et al. 2008, so that flat
// soles stay flat (ankle = knee - thigh), toes clear the floor and all stays within table 4-1 of
// the thesis. Bearing: directions of change as the literature on emotional gait reports them.
constexpr std::array<GaitStyle, kGaitMoodCount> kStyles = {{
    // normal
    {.list_deg = {0.0f, 2.0f, 4.0f, 1.0f},
     .rotation_deg = {4.5f, 3.5f, 1.5f, -2.0f},
     .stance_thigh_deg = {23.5f, 20.0f, 5.5f, -8.0f},
     .stance_knee_deg = {5.5f, 19.0f, 13.0f, 7.0f},
     .stance_ankle_deg = {-2.0f, -1.0f, 7.5f, 10.5f},
     .swing_thigh_deg = {-17.5f, -6.0f, 18.8f, 24.5f},
     .swing_knee_deg = {11.5f, 44.5f, 60.5f, 27.0f},
     .swing_ankle_deg = {18.2f, -18.5f, 2.0f, 2.0f},
     .cycle_s = 32.0f / 30.0f,
     .trunk_pitch_deg = 2.0f,
     .head_pitch_deg = 0.0f,
     .arm_forward_deg = 20.0f,
     .arm_back_deg = -22.0f,
     .elbow_forward_deg = 40.0f,
     .elbow_back_deg = 20.0f,
     .shoulder_turn_deg = 3.0f,
     .head_roll_deg = 0.0f,
     .trunk_roll_deg = 0.0f,
     .chest_pitch_deg = 0.0f,
     .shoulders_forward_deg = 0.0f,
     .shoulders_up_deg = 0.0f,
     .arm_out_deg = 6.0f,
     .finger_curl_deg = 20.0f,
     .bounce_m = 0.0f},
    // bored
    {.list_deg = {0.0f, 1.0f, 2.0f, 0.5f},
     .rotation_deg = {2.5f, 2.0f, 1.0f, -1.0f},
     .stance_thigh_deg = {18.0f, 15.0f, 4.0f, -5.0f},
     .stance_knee_deg = {8.0f, 15.0f, 11.3f, 9.6f},
     .stance_ankle_deg = {-4.0f, 0.0f, 7.3f, 12.6f},
     .swing_thigh_deg = {-11.0f, -2.0f, 18.8f, 20.5f},
     .swing_knee_deg = {14.0f, 42.0f, 54.5f, 26.5f},
     .swing_ankle_deg = {14.9f, -8.5f, 3.0f, 4.5f},
     .cycle_s = 40.0f / 30.0f,
     .trunk_pitch_deg = 7.0f,
     .head_pitch_deg = 12.0f,
     .arm_forward_deg = 10.0f,
     .arm_back_deg = -8.0f,
     .elbow_forward_deg = 15.0f,
     .elbow_back_deg = 10.0f,
     .shoulder_turn_deg = 2.0f,
     .head_roll_deg = 4.0f,
     .trunk_roll_deg = 0.0f,
     .chest_pitch_deg = 0.0f,
     .shoulders_forward_deg = 3.0f,
     .shoulders_up_deg = -1.0f,
     .arm_out_deg = 5.0f,
     .finger_curl_deg = 12.0f,
     .bounce_m = 0.0f},
    // happy
    {.list_deg = {0.0f, 4.0f, 6.0f, 1.5f},
     .rotation_deg = {7.0f, 5.5f, 2.0f, -3.5f},
     .stance_thigh_deg = {25.0f, 22.0f, 5.0f, -9.0f},
     .stance_knee_deg = {6.0f, 21.0f, 6.0f, 3.0f},
     .stance_ankle_deg = {0.0f, -1.0f, 1.0f, 7.0f},
     .swing_thigh_deg = {-18.0f, -5.5f, 15.0f, 32.0f},
     .swing_knee_deg = {9.0f, 47.0f, 66.0f, 40.0f},
     .swing_ankle_deg = {21.1f, -22.0f, -3.0f, 5.0f},
     .cycle_s = 30.0f / 30.0f,
     .trunk_pitch_deg = -2.0f,
     .head_pitch_deg = -7.0f,
     .arm_forward_deg = 32.0f,
     .arm_back_deg = -34.0f,
     .elbow_forward_deg = 52.0f,
     .elbow_back_deg = 26.0f,
     .shoulder_turn_deg = 9.0f,
     .head_roll_deg = 7.0f,
     .trunk_roll_deg = 1.5f,
     .chest_pitch_deg = -6.0f,
     .shoulders_forward_deg = 0.0f,
     .shoulders_up_deg = 1.5f,
     .arm_out_deg = 16.0f,
     .finger_curl_deg = 12.0f,
     .bounce_m = 0.011f},
    // sad
    {.list_deg = {0.0f, 1.0f, 1.0f, 0.5f},
     .rotation_deg = {2.0f, 1.5f, 1.0f, -0.5f},
     .stance_thigh_deg = {14.5f, 11.5f, 3.0f, -3.0f},
     .stance_knee_deg = {8.0f, 12.5f, 9.0f, 8.0f},
     .stance_ankle_deg = {-4.0f, 0.5f, 7.0f, 10.5f},
     .swing_thigh_deg = {-8.5f, 0.5f, 19.2f, 19.0f},
     .swing_knee_deg = {12.0f, 41.0f, 51.5f, 26.5f},
     .swing_ankle_deg = {13.6f, -6.0f, 3.0f, 6.0f},
     .cycle_s = 46.0f / 30.0f,
     .trunk_pitch_deg = 4.0f,
     .head_pitch_deg = 40.0f,
     .head_forward_deg = 6.0f,
     .arm_forward_deg = 5.0f,
     .arm_back_deg = -3.0f,
     .elbow_forward_deg = 10.0f,
     .elbow_back_deg = 8.0f,
     .shoulder_turn_deg = 0.5f,
     .head_roll_deg = 0.0f,
     .trunk_roll_deg = 0.0f,
     .chest_pitch_deg = 13.0f,
     .shoulders_forward_deg = 14.0f,
     .shoulders_up_deg = -3.0f,
     .arm_out_deg = 10.5f,
     .finger_curl_deg = 22.0f,
     .bounce_m = 0.0f},
    // angry
    {.list_deg = {0.0f, 2.0f, 4.0f, 1.0f},
     .rotation_deg = {7.5f, 5.5f, 2.0f, -3.5f},
     .stance_thigh_deg = {27.0f, 24.0f, 6.5f, -10.5f},
     .stance_knee_deg = {8.0f, 26.0f, 16.0f, 5.0f},
     .stance_ankle_deg = {0.0f, 2.0f, 9.5f, 9.0f},
     .swing_thigh_deg = {-21.0f, -8.0f, 22.0f, 33.0f},
     .swing_knee_deg = {9.0f, 45.0f, 68.0f, 36.0f},
     .swing_ankle_deg = {19.2f, -24.0f, 3.0f, 7.0f},
     .cycle_s = 28.0f / 30.0f,
     .trunk_pitch_deg = 12.0f,
     .head_pitch_deg = 22.0f,
     .head_forward_deg = 12.0f,
     .arm_forward_deg = 24.0f,
     .arm_back_deg = -36.0f,
     .elbow_forward_deg = 52.0f,
     .elbow_back_deg = 40.0f,
     .shoulder_turn_deg = 6.0f,
     .head_roll_deg = 0.0f,
     .trunk_roll_deg = 3.0f,
     .chest_pitch_deg = 3.0f,
     .shoulders_forward_deg = 6.0f,
     .shoulders_up_deg = 9.0f,
     .arm_out_deg = 18.0f,
     .finger_curl_deg = 85.0f,
     .bounce_m = 0.0f,
     .step_width_m = 0.15f},
    // hurried
    {.list_deg = {0.0f, 2.5f, 5.0f, 1.0f},
     .rotation_deg = {8.0f, 4.5f, 1.5f, -4.0f},
     .stance_thigh_deg = {27.0f, 22.5f, 3.5f, -15.0f},
     .stance_knee_deg = {9.0f, 22.5f, 11.5f, 2.0f},
     .stance_ankle_deg = {-3.0f, 0.0f, 8.0f, 7.5f},
     .swing_thigh_deg = {-24.0f, -12.0f, 18.0f, 27.5f},
     .swing_knee_deg = {8.5f, 40.0f, 62.0f, 30.0f},
     .swing_ankle_deg = {13.1f, -25.5f, 2.0f, 3.0f},
     .cycle_s = 24.0f / 30.0f,
     .trunk_pitch_deg = 12.0f,
     .head_pitch_deg = 0.0f,
     .head_forward_deg = 5.0f,
     .arm_forward_deg = 22.0f,
     .arm_back_deg = -36.0f,
     .elbow_forward_deg = 98.0f,
     .elbow_back_deg = 88.0f,
     .shoulder_turn_deg = 7.0f,
     .head_roll_deg = 0.0f,
     .trunk_roll_deg = 0.0f,
     .chest_pitch_deg = 0.0f,
     .shoulders_forward_deg = 0.0f,
     .shoulders_up_deg = 0.0f,
     .arm_out_deg = 5.0f,
     .finger_curl_deg = 28.0f,
     .bounce_m = 0.0f,
     .step_width_m = 0.07f},
    // tired
    {.list_deg = {0.0f, 1.2f, 1.2f, 0.6f},
     .rotation_deg = {2.0f, 2.0f, 1.5f, -1.0f},
     .stance_thigh_deg = {22.0f, 17.0f, 8.5f, 0.0f},
     .stance_knee_deg = {22.0f, 25.0f, 18.0f, 17.5f},
     .stance_ankle_deg = {2.0f, 8.0f, 9.5f, 16.0f},
     .swing_thigh_deg = {-5.0f, 5.0f, 24.0f, 27.0f},
     .swing_knee_deg = {26.0f, 49.0f, 56.0f, 40.0f},
     .swing_ankle_deg = {17.5f, -4.0f, 3.5f, 9.0f},
     .cycle_s = 44.0f / 30.0f,
     .trunk_pitch_deg = 22.0f,
     .head_pitch_deg = 26.0f,
     .arm_forward_deg = 9.0f,
     .arm_back_deg = -5.0f,
     .elbow_forward_deg = 8.0f,
     .elbow_back_deg = 5.0f,
     .shoulder_turn_deg = 3.0f,
     .head_roll_deg = 6.0f,
     .trunk_roll_deg = 10.0f,
     .chest_pitch_deg = 5.0f,
     .shoulders_forward_deg = 6.0f,
     .shoulders_up_deg = -5.0f,
     .arm_out_deg = 8.5f,
     .finger_curl_deg = 14.0f,
     .bounce_m = 0.0f,
     .step_width_m = 0.16f,
     .sway_m = 0.045f,
     .toe_out_deg = 11.0f},
    // proud
    {.list_deg = {0.0f, 2.0f, 3.5f, 1.0f},
     .rotation_deg = {6.0f, 4.5f, 2.0f, -2.5f},
     .stance_thigh_deg = {24.0f, 19.5f, 4.5f, -9.0f},
     .stance_knee_deg = {4.0f, 14.0f, 5.5f, 3.0f},
     .stance_ankle_deg = {0.0f, -5.5f, 1.0f, 8.0f},
     .swing_thigh_deg = {-17.0f, -4.0f, 15.5f, 30.0f},
     .swing_knee_deg = {9.0f, 46.0f, 59.0f, 30.0f},
     .swing_ankle_deg = {22.0f, -16.5f, 2.0f, 6.0f},
     .cycle_s = 38.0f / 30.0f,
     .trunk_pitch_deg = -4.0f,
     .head_pitch_deg = -11.0f,
     .arm_forward_deg = 16.0f,
     .arm_back_deg = -18.0f,
     .elbow_forward_deg = 16.0f,
     .elbow_back_deg = 8.0f,
     .shoulder_turn_deg = 5.0f,
     .head_roll_deg = 0.0f,
     .trunk_roll_deg = 0.0f,
     .chest_pitch_deg = -11.0f,
     .shoulders_forward_deg = -9.0f,
     .shoulders_up_deg = 0.0f,
     .arm_out_deg = 17.0f,
     .finger_curl_deg = 62.0f,
     .bounce_m = 0.0f},
}};

constexpr GaitStyle kStanding = {.stance_thigh_deg = {3, 3, 3, 3},
                                 .stance_knee_deg = {6, 6, 6, 6},
                                 .stance_ankle_deg = {3, 3, 3, 3},
                                 .swing_thigh_deg = {3, 14, 18, 10},
                                 .swing_knee_deg = {6, 34, 36, 18},
                                 .swing_ankle_deg = {3, 0, 4, 6},
                                 .cycle_s = 1.1f,
                                 .trunk_pitch_deg = 1,
                                 .arm_forward_deg = 2,
                                 .arm_back_deg = 2,
                                 .elbow_forward_deg = 19,
                                 .elbow_back_deg = 19,
                                 .arm_out_deg = 2,
                                 .finger_curl_deg = 18,
                                 .step_width_m = 0.17f,
                                 .sway_m = 0.03f};

// A jog at about 2.6 m/s, after capture 02_03 of the CMU database and the usual textbook ranges.
// The keys are contact, loading, mid stance and toe-off.
constexpr GaitStyle kRunning = {.list_deg = {0, 3, 1, -1},
                                .rotation_deg = {5, 2, -4, -6},
                                .stance_thigh_deg = {26, 20, 3, -17},
                                .stance_knee_deg = {20, 38, 31, 17},
                                .stance_ankle_deg = {3, 18, 28, -12},
                                .swing_thigh_deg = {-16, 6, 30, 36},
                                .swing_knee_deg = {42, 85, 98, 66},
                                .swing_ankle_deg = {-20, -8, 0, 0},
                                .cycle_s = 23.0f / 30.0f,
                                .trunk_pitch_deg = 7,
                                .head_pitch_deg = 0,
                                .arm_forward_deg = 20,
                                .arm_back_deg = -50,
                                .elbow_forward_deg = 105,
                                .elbow_back_deg = 80,
                                .shoulder_turn_deg = 6,
                                .arm_out_deg = 10,
                                .finger_curl_deg = 45,
                                .contact = 0.38f,
                                .step_width_m = 0.06f,
                                .sway_m = 0.01f};

constexpr std::array<const char*, kGaitMoodCount> kNames = {"normal", "bored",   "happy", "sad",
                                                            "angry",  "hurried", "tired", "proud"};

// Activation, evaluation.
constexpr std::array<Vec2, kGaitMoodCount> kPlaces = {{{0.0f, 0.0f},
                                                       {-0.6f, -0.3f},
                                                       {0.5f, 0.8f},
                                                       {-0.5f, -0.8f},
                                                       {0.7f, -0.75f},
                                                       {0.9f, -0.1f},
                                                       {-0.9f, -0.1f},
                                                       {0.2f, 0.55f}}};

constexpr std::size_t kFloats = sizeof(GaitStyle) / sizeof(float);
using Flat = std::array<float, kFloats>;
static_assert(sizeof(Flat) == sizeof(GaitStyle), "a style is floats and nothing else");

}  // namespace

const char* gait_mood_name(GaitMood mood) { return kNames[static_cast<std::size_t>(mood)]; }

const GaitStyle& gait_style(GaitMood mood) { return kStyles[static_cast<std::size_t>(mood)]; }
const GaitStyle& running_style() { return kRunning; }
const GaitStyle& standing_style() { return kStanding; }
Vec2 gait_mood_place(GaitMood mood) { return kPlaces[static_cast<std::size_t>(mood)]; }

GaitStyle blend(const GaitStyle& a, const GaitStyle& b, float share) {
  const Flat fa = std::bit_cast<Flat>(a);
  const Flat fb = std::bit_cast<Flat>(b);
  Flat out;
  for (std::size_t i = 0; i < kFloats; ++i) out[i] = fa[i] + (fb[i] - fa[i]) * share;
  return std::bit_cast<GaitStyle>(out);
}

GaitStyle gait_style_at(float activation, float evaluation) {
  // Shepard's interpolation with the inverse fourth power: near a mood, that mood.
  float total = 0.0f;
  std::array<float, kGaitMoodCount> weight{};
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const float da = activation - kPlaces[i].x;
    const float de = evaluation - kPlaces[i].y;
    const float d2 = da * da + de * de;
    if (d2 < 1e-6f) return kStyles[i];
    weight[i] = 1.0f / (d2 * d2);
    total += weight[i];
  }
  Flat out{};
  for (std::size_t s = 0; s < kStyles.size(); ++s) {
    const Flat f = std::bit_cast<Flat>(kStyles[s]);
    for (std::size_t i = 0; i < kFloats; ++i) out[i] += f[i] * (weight[s] / total);
  }
  return std::bit_cast<GaitStyle>(out);
}

}  // namespace caryatid::body
