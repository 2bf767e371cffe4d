#include "assets/bake/plot/error_plot.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace caryatid::bake {
namespace {

struct Measured {
  double percent = 0, mean = 0, hausdorff = 0;
};
// By mesh, then method, in the order of the file; coarse to fine.
using Methods = std::vector<std::pair<std::string, std::vector<Measured>>>;
using Meshes = std::vector<std::pair<std::string, Methods>>;

template <class List>
auto& entry(List& list, const std::string& name) {
  const auto at = std::find_if(list.begin(), list.end(), [&](auto& e) { return e.first == name; });
  if (at != list.end()) return at->second;
  list.push_back({name, {}});
  return list.back().second;
}

// simplify/MESH/METHOD/PERCENT/...
void add(const nlohmann::json& run, Meshes* meshes) {
  const std::string name = run.at("name");
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('/', at), name.size());
    parts.push_back(name.substr(at, end - at));
    at = end + 1;
  }
  if (parts.size() < 4 || parts[0] != "simplify" || !(run.at("mean").get<double>() > 0)) return;
  entry(entry(*meshes, parts[1]), parts[2])
      .push_back({std::stod(parts[3]), run.at("mean"), run.at("hausdorff")});
}

ChartPanel panel_of(const std::string& mesh, const Methods& methods) {
  ChartPanel panel;
  panel.title = mesh;
  panel.log_y = true;
  for (const Measured& m : methods[0].second) panel.x.push_back(m.percent);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    ChartLine mean{methods[i].first, chart_color(i), {}, false, 2.4};
    ChartLine most{"", chart_color(i), {}, false, 1.0};
    for (const Measured& m : methods[i].second) {
      mean.y.push_back(m.mean);
      most.y.push_back(m.hausdorff);
    }
    panel.lines.push_back(mean);
    panel.lines.push_back(most);
  }
  return panel;
}

}  // namespace

Chart error_chart(const std::string& text, const std::string& file) {
  Meshes meshes;
  try {
    const nlohmann::json all = nlohmann::json::parse(text);
    for (const auto& run : all.at("benchmarks"))
      if (run.contains("mean")) add(run, &meshes);
  } catch (const std::exception&) {
    meshes.clear();
  }
  if (meshes.empty())
    throw std::runtime_error(file +
                             ": no errors of meshes; make it with caryatid-bench --filter "
                             "simplify --json FILE");
  Chart chart;
  chart.title =
      "Distance to the original: mean (thick) and Hausdorff (thin), parts of the diagonal";
  chart.x_title = "faces left, %";
  chart.log_x = true;
  for (const auto& [mesh, methods] : meshes) chart.panels.push_back(panel_of(mesh, methods));
  return chart;
}

}  // namespace caryatid::bake
