#pragma once
// What a face stream's rate costs in error: a table and a plot.
#include <functional>

#include "assets/bake/stream/clip_files.h"

namespace caryatid::bake {

struct RatePoint {
  double kbit_per_s = 0.0;
  float step_mm = 0.0f;
  std::size_t fap_count = 0;  // FAPs that are sent; the others are restored.
  PointError error;
};

// Plans, encodes and decodes the face of the clip at rates from 0.5 to 8 kbit/s, as far as they
// are reached.
// `measure` compares the original with what was decoded: point_error, or HeadMeter::measure.
using Measure = std::function<PointError(const std::vector<face::FapFrame>& original,
                                         const std::vector<face::FapFrame>& decoded)>;
std::vector<RatePoint> measure_rates(const AnimationClip& clip, std::size_t intra_every,
                                     const Measure& measure);

// SVG: error over rate, both logarithmic.
std::string plot_rates(const std::vector<RatePoint>& points);

}  // namespace caryatid::bake
