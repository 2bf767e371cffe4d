#pragma once
// Charts as SVG: panels of lines over one horizontal axis. For the README's figures and
// `caryatid-tool plot`. Text out, nothing kept; a chart of a day's frames stays small, because
// lines are drawn as their extremes by column of pixels.
#include <string>
#include <utility>
#include <vector>

namespace caryatid::bake {

struct ChartLine {
  std::string name;       // In the legend; empty: none.
  std::string color;      // "#rrggbb"
  std::vector<double> y;  // As long as its panel's x; NaN breaks the line.
  bool steps = false;     // Holds its value until the next sample.
  double width = 1.6;
};

struct ChartPanel {
  std::string title;  // With its unit: "frame time, ms".
  std::vector<double> x;
  std::vector<ChartLine> lines;
  std::vector<std::pair<std::string, double>> limits;  // Dashed horizontals with a name.
  std::vector<std::pair<double, double>> marks;        // Red dots; named in the legend:
  std::string marks_name;                              // "late frame"
  std::vector<std::pair<double, double>> bands;        // Shaded stretches of x, with
  std::string bands_name;                              // their name at the first.
  double low = 0.0, high = 0.0;  // Range of y; equal: from the data, with 0 when all is positive.
  double height = 200.0;         // Pixels.
  bool log_y = false;            // Values > 0 only; so with log_x of the chart.
};

struct Chart {
  std::string title, x_title;
  std::vector<ChartPanel> panels;
  double width = 960.0;
  bool log_x = false;
};

// Round numbers from low to high, about `count` of them: steps of 1, 2 or 5 by a power of ten.
std::vector<double> ticks(double low, double high, int count);
// 1, 2 and 5 by powers of ten between low and high, both > 0.
std::vector<double> log_ticks(double low, double high);

// Colours that stay apart in print and for colour-blind eyes (Okabe and Ito 2008), by index.
const char* chart_color(std::size_t index);

std::string chart_svg(const Chart& chart);

}  // namespace caryatid::bake
