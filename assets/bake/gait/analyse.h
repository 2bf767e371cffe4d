#pragma once
// From a captured gait back to its parametric form: cycles, the thesis's four phases (5.2), stance
// and swing, the style whose key poses it shows, the mood nearest to it, and how well that form
// resynthesised meets the capture.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "assets/bake/gait/motion.h"
#include "core/body/gait_cycle.h"
#include "core/body/gait_style.h"

namespace caryatid::bake {

struct GaitPhase {
  float percent = 0.0f;  // Of the cycle, from the heel strike of the stance leg.
  bool nominal = false;  // The window had no inner extremum: the thesis's percentage stands in.
};

// One cycle of one leg, from heel strike to heel strike.
struct Stride {
  bool left = true;
  std::size_t begin = 0, end = 0;  // Frames.
  float length_m = 0.0f;           // 0 where the source does not travel.
  float seconds = 0.0f;
  GaitPhase recoil, passing, anticipation, toe_off;
};

// Degrees on 51 points of the cycle (every 2 %): mean of all strides.
struct CycleCurves {
  std::array<float, 51> thigh{}, knee{}, ankle{};
  std::array<float, 51> list{}, rotation{};  // Pelvis: side of the leg up, forward.
};

struct GaitAnalysis {
  std::vector<Stride> strides;
  std::array<std::vector<std::size_t>, 2> heel_strikes;  // [0] left, [1] right; frames.
  bool runs = false;
  float speed_mps = 0.0f, cadence_spm = 0.0f;
  CycleCurves measured;   // Both legs together.
  body::GaitStyle style;  // Parametric form.
  body::GaitMood mood = body::GaitMood::normal;
  std::array<float, body::kGaitMoodCount> mood_distance{};
  CycleCurves resynthesised;
  float thigh_rms_deg = 0.0f, knee_rms_deg = 0.0f;  // Resynthesised against measured.
};

// Throws std::runtime_error when there is not one whole stride.
GaitAnalysis analyse_gait(const Motion& motion);

// The curves of a style walked by our generic body.
CycleCurves walked_curves(const body::GaitStyle& style,
                          body::GaitInterpolation interpolation = body::GaitInterpolation::smooth);

// Share (0..1) of the cycle at which a curve lies within two standard deviations of the norm.
struct NormativeFit {
  float hip = 0.0f, knee = 0.0f, ankle = 0.0f, list = 0.0f, rotation = 0.0f;
};
NormativeFit fit_to_norm(const CycleCurves& curves);

std::string report_json(const GaitAnalysis& analysis);
// Thigh, knee, ankle and the two turns of the pelvis over the cycle before the normative bands.
struct NamedCurves {
  std::string name;
  const CycleCurves* curves = nullptr;
};
std::string curves_svg(std::span<const NamedCurves> curves);

}  // namespace caryatid::bake
