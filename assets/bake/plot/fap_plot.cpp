// The curves of a .fap file, by region of the face.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "assets/bake/plot/metrics_plot.h"
#include "core/face/fap_table.h"
#include "core/stream/fap_text.h"

namespace caryatid::bake {
namespace {

struct Region {
  const char* title;
  std::span<const int> faps;
  bool degrees;  // Rotations come in 1e-5 rad.
};

constexpr std::array<int, 8> kMouth{3, 4, 5, 6, 7, 12, 13, 16};
constexpr std::array<int, 10> kLips{8, 9, 10, 11, 51, 52, 53, 54, 59, 60};
constexpr std::array<int, 14> kLids{19, 20, 21, 22, 31, 32, 33, 34, 35, 36, 37, 38, 41, 42};
constexpr std::array<int, 7> kTurns{23, 24, 25, 26, 48, 49, 50};
constexpr std::array<Region, 4> kRegions{{{"jaw and mouth, FAPU", kMouth, false},
                                          {"lips, FAPU", kLips, false},
                                          {"lids, brows, cheeks, FAPU", kLids, false},
                                          {"eyes and head, degrees", kTurns, true}}};
constexpr std::size_t kLinesByRegion = 4;

struct Curves {
  double fps = 25.0;
  std::vector<double> time_s;
  std::vector<face::FapFrame> frames;
};

Curves read_curves(const std::string& text, const std::string& file) {
  Curves curves;
  stream::FapTextReader reader({text.data(), text.size()});
  face::FapFrame frame;
  Status status = reader.next(&frame);
  if (reader.header().frames_per_second > 0.0f)
    curves.fps = static_cast<double>(reader.header().frames_per_second);
  for (; status.ok(); status = reader.next(&frame)) {
    curves.time_s.push_back(static_cast<double>(curves.frames.size()) / curves.fps);
    curves.frames.push_back(frame);
  }
  if (status.code != Code::not_ready)
    throw std::runtime_error(file + ":" + std::to_string(reader.line()) + ": " +
                             stream::describe_text_fault(status) + "; mend or shorten the file");
  if (curves.frames.empty()) throw std::runtime_error(file + ": no frames; give a .fap text file");
  return curves;
}

// The FAPs of a region that move most, most first.
std::vector<int> movers(const Curves& curves, const Region& region) {
  std::vector<std::pair<float, int>> range;
  for (const int fap : region.faps) {
    float low = 0.0f, high = 0.0f;
    for (const face::FapFrame& f : curves.frames) {
      low = std::min(low, f.get(fap));
      high = std::max(high, f.get(fap));
    }
    if (high > low) range.emplace_back(low - high, fap);
  }
  std::sort(range.begin(), range.end());
  std::vector<int> out;
  for (std::size_t i = 0; i < std::min(range.size(), kLinesByRegion); ++i)
    out.push_back(range[i].second);
  return out;
}

}  // namespace

Chart fap_chart(const std::string& text, const std::string& file) {
  const Curves curves = read_curves(text, file);
  Chart chart;
  const std::size_t slash = file.find_last_of('/');
  chart.title = file.substr(slash == std::string::npos ? 0 : slash + 1);
  chart.x_title = "time, s";
  for (const Region& region : kRegions) {
    const std::vector<int> faps = movers(curves, region);
    if (faps.empty()) continue;
    ChartPanel panel;
    panel.title = region.title;
    panel.x = curves.time_s;
    panel.height = 170.0;
    for (std::size_t i = 0; i < faps.size(); ++i) {
      ChartLine line{std::to_string(faps[i]) + " " + face::fap_info(faps[i]).name,
                     chart_color(i),
                     {},
                     false,
                     1.6};
      const double unit = region.degrees ? 1e-5 * 180.0 / 3.14159265358979 : 1.0;
      for (const face::FapFrame& f : curves.frames)
        line.y.push_back(unit * static_cast<double>(f.get(faps[i])));
      panel.lines.push_back(std::move(line));
    }
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace caryatid::bake
