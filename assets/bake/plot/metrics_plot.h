#pragma once
// Charts of what a run of caryatid leaves: its metrics, and the FAP files that it plays.
#include <string>
#include <vector>

#include "assets/bake/plot/chart.h"

namespace caryatid::bake {

// One run of `caryatid --metrics`: a JSON object a line. Unknown keys are ignored.
struct MetricsRun {
  std::string name;                                                     // Of the file, for titles.
  std::vector<double> time_s, cpu_ms, gpu_ms, triangles, render_scale;  // NaN: null or absent.
  std::vector<bool> late, hot;  // hot: "throttled" of the board simulation; else false.
  std::vector<std::pair<std::string, std::vector<double>>> objects;  // "lod", in file order.
};

// Throws std::runtime_error "FILE:LINE: what; cure" on a line that is no JSON object, lacks time_s
// or triangles, or goes back in time; and on a file without frames.
MetricsRun parse_metrics(const std::string& text, const std::string& file);

// Frame time of each run (late frames marked, the period dashed), then triangles and render scale.
// One run also shows its objects' triangles; several are laid over each other for comparison.
Chart metrics_chart(const std::vector<MetricsRun>& runs);

// A .fap file: the FAPs that move most, by region, against time. Throws as above.
Chart fap_chart(const std::string& text, const std::string& file);

}  // namespace caryatid::bake
