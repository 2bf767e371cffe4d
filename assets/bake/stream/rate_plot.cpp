#include "assets/bake/stream/rate_plot.h"

#include <cmath>
#include <cstdio>

namespace caryatid::bake {
namespace {

constexpr double kRates[] = {0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0};
constexpr double kWidth = 720, kHeight = 420, kLeft = 70, kTop = 30, kRight = 20, kBottom = 60;
constexpr double kLeastRate = 0.4, kMostRate = 10.0, kLeastError_mm = 0.03, kMostError_mm = 10.0;

double x_of(double rate) {
  const double t = std::log(rate / kLeastRate) / std::log(kMostRate / kLeastRate);
  return kLeft + t * (kWidth - kLeft - kRight);
}
double y_of(double error_mm) {
  const double clamped = std::min(std::max(error_mm, kLeastError_mm), kMostError_mm);
  const double t = std::log(clamped / kLeastError_mm) / std::log(kMostError_mm / kLeastError_mm);
  return kHeight - kBottom - t * (kHeight - kTop - kBottom);
}

template <class... Values>
void put(std::string* out, const char* format, Values... values) {
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  *out += line;
}

void draw_grid(std::string* out) {
  for (const double rate : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    put(out, "<line x1='%.1f' y1='%.1f' x2='%.1f' y2='%.1f' stroke='#ddd'/>\n", x_of(rate), kTop,
        x_of(rate), kHeight - kBottom);
    put(out, "<text x='%.1f' y='%.1f' text-anchor='middle'>%g</text>\n", x_of(rate),
        kHeight - kBottom + 18, rate);
  }
  for (const double error : {0.03, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    put(out, "<line x1='%.1f' y1='%.1f' x2='%.1f' y2='%.1f' stroke='#ddd'/>\n", kLeft, y_of(error),
        kWidth - kRight, y_of(error));
    put(out, "<text x='%.1f' y='%.1f' text-anchor='end'>%g</text>\n", kLeft - 6, y_of(error) + 4,
        error);
  }
  put(out, "<text x='%.1f' y='%.1f' text-anchor='middle'>rate, kbit/s</text>\n",
      (kLeft + kWidth - kRight) / 2, kHeight - 16);
  put(out,
      "<text transform='translate(18 %.1f) rotate(-90)' text-anchor='middle'>error at the feature "
      "points, mm</text>\n",
      (kTop + kHeight - kBottom) / 2);
}

void draw_line(const std::vector<RatePoint>& points, double PointError::*which, const char* colour,
               const char* label, std::string* out) {
  *out += "<polyline fill='none' stroke-width='2' stroke='";
  *out += std::string(colour) + "' points='";
  for (const RatePoint& p : points)
    put(out, "%.1f,%.1f ", x_of(p.kbit_per_s), y_of(p.error.*which));
  *out += "'/>\n";
  for (const RatePoint& p : points)
    put(out, "<circle cx='%.1f' cy='%.1f' r='3' fill='%s'/>\n", x_of(p.kbit_per_s),
        y_of(p.error.*which), colour);
  if (!points.empty())
    put(out, "<text x='%.1f' y='%.1f' fill='%s'>%s</text>\n", x_of(points.back().kbit_per_s) + 10,
        y_of(points.back().error.*which) + 5, colour, label);
}

}  // namespace

std::vector<RatePoint> measure_rates(const AnimationClip& clip, std::size_t intra_every,
                                     const Measure& measure) {
  std::vector<RatePoint> points;
  std::vector<stream::ModelNode> nodes(1 << 20);
  for (const double rate : kRates) {
    stream::FbaSettings settings;
    settings.rate = rate_of(clip.frames_per_second);
    settings.repeat_ranges = false;
    stream::RatePlan plan;
    if (!stream::plan_rate(clip.view(intra_every), rate, nodes, &settings, &plan).ok()) continue;
    if (!points.empty() && points.back().step_mm == plan.step_mm) continue;
    const std::vector<std::byte> bytes = encode_fba(clip, intra_every, settings);
    stream::FbaDecoder decoder(nodes, {});
    decoder.refill(bytes, true);
    std::vector<face::FapFrame> decoded;
    stream::FbaPlane plane;
    face::FapFrame face;
    body::BapFrame body;
    while (decoder.next(&plane, &face, &body).ok()) decoded.push_back(face);
    points.push_back(
        {plan.kbit_per_s, plan.step_mm, settings.fap_mask.count(), measure(clip.face, decoded)});
  }
  return points;
}

std::string plot_rates(const std::vector<RatePoint>& points) {
  std::string out;
  put(&out,
      "<svg xmlns='http://www.w3.org/2000/svg' width='%g' height='%g' font-family='sans-serif' "
      "font-size='13'>\n<rect width='100%%' height='100%%' fill='white'/>\n",
      kWidth, kHeight);
  draw_grid(&out);
  draw_line(points, &PointError::mean_mm, "#1f6fb4", "mean", &out);
  draw_line(points, &PointError::p99_mm, "#c0392b", "99 %", &out);
  return out + "</svg>\n";
}

}  // namespace caryatid::bake
