#include "assets/bake/plot/chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace caryatid::bake {
namespace {

constexpr double kLeft = 70.0, kRight = 24.0, kTop = 52.0, kGap = 62.0, kBottom = 52.0;
constexpr const char* kInk = "#222222";
constexpr const char* kFaint = "#6b6b6b";

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", std::round(v * 1e6) / 1e6);
  return text;
}

std::string pixel(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '\'' ? "&#39;" : std::string(1, c);
  return out;
}

std::string words(double x, double y, const std::string& text, const char* color,
                  const char* anchor = "start", const char* more = "") {
  return "<text x='" + pixel(x) + "' y='" + pixel(y) + "' fill='" + color + "' text-anchor='" +
         anchor + "' " + more + ">" + escaped(text) + "</text>\n";
}

std::string segment(double x0, double y0, double x1, double y1, const std::string& stroke) {
  return "<line x1='" + pixel(x0) + "' y1='" + pixel(y0) + "' x2='" + pixel(x1) + "' y2='" +
         pixel(y1) + "' " + stroke + "/>\n";
}

// One panel in place: maps its data to pixels.
struct Frame {
  const ChartPanel& panel;
  double left, top, wide, x_low, x_high, low, high;
  bool log_x;
  double x(double v) const { return left + wide * part(v, x_low, x_high, log_x); }
  double y(double v) const { return top + panel.height * (1.0 - part(v, low, high, panel.log_y)); }
  static double part(double v, double low, double high, bool logarithmic) {
    if (logarithmic) return std::log(v / low) / std::max(std::log(high / low), 1e-12);
    return (v - low) / std::max(high - low, 1e-12);
  }
};

std::pair<double, double> range_of(const ChartPanel& panel) {
  if (panel.low < panel.high) return {panel.low, panel.high};
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  const auto see = [&](double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  };
  for (const ChartLine& line : panel.lines)
    for (const double v : line.y) see(v);
  for (const auto& [name, v] : panel.limits) see(v);
  if (panel.log_y) return low > high ? std::pair{1.0, 10.0} : std::pair{low / 1.15, high * 1.15};
  if (low > high) return {0.0, 1.0};
  if (low > 0.0) low = 0.0;
  const double room = std::max((panel.limits.empty() ? 0.06 : 0.16) * (high - low), 1e-6);
  return {low == 0.0 ? 0.0 : low - room, high + room};
}

// Every column of pixels shows the least and the greatest value that falls into it.
std::string path_of(const Frame& f, const ChartLine& line) {
  std::string path;
  bool pen = false;
  const auto go = [&](double x, double y) {
    path += (pen ? " L" : " M") + pixel(x) + " " + pixel(y);
    pen = true;
  };
  const std::size_t count = std::min(line.y.size(), f.panel.x.size());
  for (std::size_t i = 0; i < count;) {
    if (!std::isfinite(line.y[i])) {
      pen = false;
      ++i;
      continue;
    }
    const double column = std::floor(f.x(f.panel.x[i]));
    double low = line.y[i], high = low, last = low;
    const double x = f.x(f.panel.x[i]);
    std::size_t end = i;
    for (; end < count && std::isfinite(line.y[end]) && std::floor(f.x(f.panel.x[end])) == column;
         ++end) {
      last = line.y[end];
      low = std::min(low, last);
      high = std::max(high, last);
    }
    if (line.steps && pen && i > 0) go(x, f.y(line.y[i - 1]));
    go(x, f.y(line.y[i]));
    if (end - i > 2 && high > low) {
      go(x, f.y(low));
      go(x, f.y(high));
    }
    if (end - i > 1) go(x, f.y(last));
    i = end;
  }
  return path;
}

std::string axes(const Frame& f, bool name_x) {
  std::string out;
  for (const double v : f.panel.log_y ? log_ticks(f.low, f.high) : ticks(f.low, f.high, 5)) {
    out += segment(f.left, f.y(v), f.left + f.wide, f.y(v), "stroke='#e4e4e4'");
    out += words(f.left - 8, f.y(v) + 4, number(v), kFaint, "end");
  }
  for (const double v : f.log_x ? log_ticks(f.x_low, f.x_high) : ticks(f.x_low, f.x_high, 10)) {
    const double bottom = f.top + f.panel.height;
    out += segment(f.x(v), bottom, f.x(v), bottom + 4, "stroke='#888888'");
    if (name_x) out += words(f.x(v), bottom + 18, number(v), kFaint, "middle");
  }
  out += segment(f.left, f.top + f.panel.height, f.left + f.wide, f.top + f.panel.height,
                 "stroke='#888888'");
  return out;
}

std::string legend(const Frame& f) {
  std::string out;
  double x = f.left + f.wide;  // From the right; about 7.3 pixels a letter.
  const auto place = [&](const std::string& name) {
    x -= 7.3 * static_cast<double>(name.size());
    out += words(x, f.top - 9, name, kInk);
    x -= 26;
  };
  const double y = f.top - 13;
  if (!f.panel.marks.empty() && !f.panel.marks_name.empty()) {
    place(f.panel.marks_name + " (" + std::to_string(f.panel.marks.size()) + ")");
    out += "<circle cx='" + pixel(x + 16) + "' cy='" + pixel(y) + "' r='3.2' fill='#d1001f'/>\n";
    x -= 12;
  }
  for (std::size_t i = f.panel.lines.size(); i-- > 0;) {
    const ChartLine& line = f.panel.lines[i];
    if (line.name.empty()) continue;
    place(line.name);
    out += segment(x, y, x + 20, y, "stroke='" + line.color + "' stroke-width='2.5'");
    x -= 12;
  }
  return out;
}

std::string draw(const Frame& f, bool name_x) {
  const ChartPanel& p = f.panel;
  std::string out = words(f.left, f.top - 9, p.title, kInk, "start", "font-weight='600'");
  for (std::size_t i = 0; i < p.bands.size(); ++i) {
    const double x0 = f.x(std::max(p.bands[i].first, f.x_low));
    const double x1 = f.x(std::min(p.bands[i].second, f.x_high));
    out += "<rect x='" + pixel(x0) + "' y='" + pixel(f.top) + "' width='" +
           pixel(std::max(x1 - x0, 0.5)) + "' height='" + pixel(p.height) + "' fill='#ffe9d6'/>\n";
  }
  out += axes(f, name_x);
  for (const auto& [name, v] : p.limits) {
    out +=
        segment(f.left, f.y(v), f.left + f.wide, f.y(v), "stroke='#444444' stroke-dasharray='5 4'");
    out += words(f.left + f.wide - 4, f.y(v) - 5, name, kInk, "end");
  }
  for (const ChartLine& line : p.lines)
    out += "<path d='" + path_of(f, line) + "' fill='none' stroke='" + line.color +
           "' stroke-width='" + pixel(line.width) + "' stroke-linejoin='round'/>\n";
  // Dense dots lose their rims, or nothing else would be seen of them.
  const std::string rim = p.marks.size() > 150 ? "" : " stroke='white' stroke-width='0.8'";
  for (const auto& [x, y] : p.marks)
    out += "<circle cx='" + pixel(f.x(x)) + "' cy='" +
           pixel(std::clamp(f.y(y), f.top, f.top + p.height)) + "' r='" +
           (rim.empty() ? "2.2" : "3.2") + "' fill='#d1001f'" + rim + "/>\n";
  if (!p.bands.empty())
    out += words(f.x(std::max(p.bands[0].first, f.x_low)) + 5, f.top + p.height - 6, p.bands_name,
                 "#a65a1b");
  return out + legend(f);
}

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  std::vector<double> out;
  if (!(high > low) || count < 1) return out;
  const double rough = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double part = rough / power;
  const double step = power * (part <= 1.0 ? 1.0 : part <= 2.0 ? 2.0 : part <= 5.0 ? 5.0 : 10.0);
  for (double v = std::ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step)
    out.push_back(std::abs(v) < 1e-9 * step ? 0.0 : v);
  return out;
}

std::vector<double> log_ticks(double low, double high) {
  std::vector<double> out;
  for (double ten = std::pow(10.0, std::floor(std::log10(low))); ten <= high; ten *= 10.0)
    for (const double v : {ten, 2.0 * ten, 5.0 * ten})
      if (v >= low * (1.0 - 1e-9) && v <= high * (1.0 + 1e-9)) out.push_back(v);
  return out;
}

const char* chart_color(std::size_t index) {
  constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                     "#56b4e9", "#8a6d00", "#5b3a9e", "#444444"};
  return kColors[index % 8];
}

std::string chart_svg(const Chart& chart) {
  double x_low = std::numeric_limits<double>::max(), x_high = std::numeric_limits<double>::lowest();
  double height = kTop + kBottom;
  for (const ChartPanel& p : chart.panels) {
    height += p.height + kGap;
    for (const double v : p.x) {
      x_low = std::min(x_low, v);
      x_high = std::max(x_high, v);
    }
  }
  height -= kGap - 30.0;
  if (x_low > x_high) x_low = 0.0, x_high = 1.0;
  std::string out = "<svg xmlns='http://www.w3.org/2000/svg' width='" + pixel(chart.width) +
                    "' height='" + pixel(height) + "' viewBox='0 0 " + pixel(chart.width) + " " +
                    pixel(height) +
                    "' font-family='Helvetica, Arial, sans-serif' font-size='12.5'>\n"
                    "<rect width='100%' height='100%' fill='white'/>\n";
  out += words(kLeft, 24, chart.title, kInk, "start", "font-size='16' font-weight='700'");
  double top = kTop + 16.0;
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const ChartPanel& panel = chart.panels[i];
    const auto [low, high] = range_of(panel);
    out += draw(
        {panel, kLeft, top, chart.width - kLeft - kRight, x_low, x_high, low, high, chart.log_x},
        i + 1 == chart.panels.size());
    top += panel.height + kGap;
  }
  out += words(chart.width - kRight, top - kGap + 38, chart.x_title, kInk, "end");
  return out + "</svg>\n";
}

}  // namespace caryatid::bake
