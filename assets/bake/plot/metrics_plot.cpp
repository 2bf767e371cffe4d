#include "assets/bake/plot/metrics_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace caryatid::bake {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& what) {
  throw std::runtime_error(file + ":" + std::to_string(line) + ": " + what +
                           "; give a file that caryatid --metrics wrote");
}

double number_of(const nlohmann::json& frame, const char* key) {
  const auto found = frame.find(key);
  return found != frame.end() && found->is_number() ? found->get<double>() : kNone;
}

bool flag_of(const nlohmann::json& frame, const char* key) {
  const auto found = frame.find(key);
  return found != frame.end() && found->is_boolean() && found->get<bool>();
}

void add_objects(const nlohmann::json& frame, MetricsRun& run) {
  const std::size_t before = run.time_s.size() - 1;
  const auto lod = frame.find("lod");
  if (lod != frame.end() && lod->is_object()) {
    for (const auto& [name, value] : lod->items()) {
      if (!value.is_number()) continue;
      auto known = std::find_if(run.objects.begin(), run.objects.end(),
                                [&](const auto& o) { return o.first == name; });
      if (known == run.objects.end()) {
        run.objects.emplace_back(name, std::vector<double>(before, kNone));
        known = run.objects.end() - 1;
      }
      known->second.resize(before, kNone);
      known->second.push_back(value.get<double>());
    }
  }
  for (auto& object : run.objects) object.second.resize(before + 1, kNone);
}

double period_ms(const MetricsRun& run) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < run.time_s.size(); ++i)
    steps.push_back(1e3 * (run.time_s[i] - run.time_s[i - 1]));
  if (steps.empty()) return kNone;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  return steps[steps.size() / 2];
}

std::vector<std::pair<double, double>> hot_bands(const MetricsRun& run) {
  std::vector<std::pair<double, double>> bands;
  for (std::size_t i = 0; i < run.hot.size(); ++i) {
    if (!run.hot[i]) continue;
    if (i == 0 || !run.hot[i - 1]) bands.emplace_back(run.time_s[i], run.time_s[i]);
    bands.back().second = run.time_s[i];
  }
  return bands;
}

ChartPanel time_panel(const MetricsRun& run, bool alone) {
  ChartPanel panel;
  panel.title = alone ? "frame time, ms" : run.name + ": frame time, ms";
  panel.x = run.time_s;
  std::vector<double> sum(run.cpu_ms.size());
  bool has_gpu = false;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    has_gpu = has_gpu || std::isfinite(run.gpu_ms[i]);
    sum[i] = run.cpu_ms[i] + (std::isfinite(run.gpu_ms[i]) ? run.gpu_ms[i] : 0.0);
    if (run.late[i]) panel.marks.emplace_back(run.time_s[i], sum[i]);
  }
  if (has_gpu) panel.lines.push_back({"CPU + GPU", chart_color(0), sum, false, 1.0});
  panel.lines.push_back({"CPU", chart_color(2), run.cpu_ms, false, 1.0});
  const double period = period_ms(run);
  if (std::isfinite(period)) {
    char text[48];
    std::snprintf(text, sizeof text, "%.1f ms", period);
    panel.limits.emplace_back(text, period);
  }
  panel.marks_name = "late";
  panel.bands = hot_bands(run);
  panel.bands_name = "throttled";
  panel.height = alone ? 230.0 : 150.0;
  return panel;
}

ChartPanel comparison(const std::vector<MetricsRun>& runs, const std::string& title,
                      std::vector<double> MetricsRun::*values) {
  ChartPanel panel;
  panel.title = title;
  panel.bands = hot_bands(runs[0]);
  panel.bands_name = "throttled";
  // Several runs share one axis: their samples are put on the first run's times.
  panel.x = runs[0].time_s;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const MetricsRun& run = runs[r];
    ChartLine line{runs.size() > 1 ? run.name : "all", chart_color(r), {}, true, 2.0};
    std::size_t at = 0;
    for (const double t : panel.x) {
      while (at + 1 < run.time_s.size() && run.time_s[at + 1] <= t) ++at;
      line.y.push_back((run.*values)[at]);
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

// The largest objects beside the sum; more than five lines can't be told apart.
void add_object_lines(const MetricsRun& run, ChartPanel& panel) {
  std::vector<std::pair<double, std::size_t>> size;
  for (std::size_t o = 0; o < run.objects.size(); ++o) {
    double most = 0.0;
    for (const double v : run.objects[o].second)
      if (std::isfinite(v)) most = std::max(most, v);
    size.emplace_back(-most, o);
  }
  std::sort(size.begin(), size.end());
  for (std::size_t i = 0; i < std::min<std::size_t>(size.size(), 5); ++i) {
    const auto& [name, values] = run.objects[size[i].second];
    panel.lines.push_back({name, chart_color(i + 1), values, true, 1.4});
  }
}

}  // namespace

MetricsRun parse_metrics(const std::string& text, const std::string& file) {
  MetricsRun run;
  const std::size_t slash = file.find_last_of('/');
  run.name = file.substr(slash == std::string::npos ? 0 : slash + 1);
  run.name = run.name.substr(0, run.name.find_last_of('.'));
  std::istringstream in(text);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const nlohmann::json frame = nlohmann::json::parse(line, nullptr, false);
    if (!frame.is_object()) refuse(file, number, "not a JSON object");
    const double time_s = number_of(frame, "time_s"), triangles = number_of(frame, "triangles");
    if (!std::isfinite(time_s) || !std::isfinite(triangles))
      refuse(file, number, "time_s or triangles is missing");
    if (!run.time_s.empty() && time_s < run.time_s.back()) refuse(file, number, "time_s goes back");
    run.time_s.push_back(time_s);
    run.triangles.push_back(triangles);
    run.cpu_ms.push_back(number_of(frame, "cpu_ms"));
    run.gpu_ms.push_back(number_of(frame, "gpu_ms"));
    run.render_scale.push_back(number_of(frame, "render_scale"));
    run.late.push_back(flag_of(frame, "late"));
    run.hot.push_back(flag_of(frame, "throttled"));
    add_objects(frame, run);
  }
  if (run.time_s.empty()) refuse(file, 1, "no frames");
  return run;
}

Chart metrics_chart(const std::vector<MetricsRun>& runs) {
  Chart chart;
  chart.x_title = "time, s";
  if (runs.empty()) return chart;
  const bool alone = runs.size() == 1;
  chart.title = alone ? runs[0].name : "Frame time and level of detail";
  for (const MetricsRun& run : runs) chart.panels.push_back(time_panel(run, alone));
  ChartPanel triangles = comparison(runs, "triangles drawn", &MetricsRun::triangles);
  if (alone) add_object_lines(runs[0], triangles);
  chart.panels.push_back(std::move(triangles));
  ChartPanel scale =
      comparison(runs, "render scale (of width and height)", &MetricsRun::render_scale);
  if (alone) scale.lines[0].name.clear();
  scale.low = 0.4;
  scale.high = 1.05;
  scale.height = 80.0;
  chart.panels.push_back(std::move(scale));
  return chart;
}

}  // namespace caryatid::bake
