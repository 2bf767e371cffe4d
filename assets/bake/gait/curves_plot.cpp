#include <sstream>

#include "assets/bake/gait/analyse.h"
#include "assets/bake/gait/normative.h"

namespace caryatid::bake {
namespace {

constexpr float kWide = 520.0f, kHigh = 260.0f, kLeft = 60.0f, kTop = 40.0f;

struct Panel {
  const char* title;
  float low, high;  // Degrees.
  float x(std::size_t i) const { return kLeft + kWide * static_cast<float>(i) / 50.0f; }
  float y(float degrees) const { return kTop + kHigh * (high - degrees) / (high - low); }
};

const std::array<float, 51>& curve_of(const CycleCurves& c, std::size_t panel) {
  const std::array<float, 51>* curves[] = {&c.thigh, &c.knee, &c.ankle, &c.list, &c.rotation};
  return *curves[panel];
}

}  // namespace

std::string curves_svg(std::span<const NamedCurves> curves) {
  constexpr std::array<Panel, 5> kPanels = {Panel{"thigh against the vertical, degrees", -40, 50},
                                            Panel{"knee flexion, degrees", -15, 110},
                                            Panel{"ankle dorsiflexion, degrees", -45, 45},
                                            Panel{"pelvic list, side of the leg up", -20, 20},
                                            Panel{"pelvic rotation, side forward", -20, 20}};
  constexpr std::array<const char*, 6> kColors = {"#c33", "#26c", "#2a2", "#a4a", "#c80", "#066"};
  std::ostringstream out;
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << kLeft + kWide + 90 << "' height='"
      << kPanels.size() * (kHigh + 80) + 20 << "' font-family='sans-serif' font-size='13'>"
      << "<rect width='100%' height='100%' fill='white'/>\n";
  for (std::size_t p = 0; p < kPanels.size(); ++p) {
    const Panel& panel = kPanels[p];
    out << "<g transform='translate(0," << static_cast<float>(p) * (kHigh + 80) << ")'>\n<polygon "
        << "fill='#ddd' points='";
    const auto mean_and_sd = [&](std::size_t i) {
      const NormativeRow& n = normative_walk()[i];
      if (p == 0) return std::pair<float, float>{n.hip - n.pelvis_tilt, n.hip_sd};
      const std::pair<float, float> norms[] = {{n.knee, n.knee_sd},
                                               {n.ankle, n.ankle_sd},
                                               {n.list, n.list_sd},
                                               {n.rotation, n.rotation_sd}};
      return norms[p - 1];
    };
    for (std::size_t i = 0; i < 51; ++i) {
      const auto [mean, sd] = mean_and_sd(i);
      out << panel.x(i) << ',' << panel.y(mean + 2 * sd) << ' ';
    }
    for (std::size_t i = 51; i-- > 0;) {
      const auto [mean, sd] = mean_and_sd(i);
      out << panel.x(i) << ',' << panel.y(mean - 2 * sd) << ' ';
    }
    out << "'/>\n";
    for (float d = panel.low - static_cast<float>(static_cast<int>(panel.low) % 20);
         d <= panel.high; d += 20.0f)
      out << "<line x1='" << kLeft << "' x2='" << kLeft + kWide << "' y1='" << panel.y(d)
          << "' y2='" << panel.y(d) << "' stroke='#bbb' stroke-width='0.7'/><text x='24' y='"
          << panel.y(d) + 4 << "'>" << d << "</text>\n";
    for (const std::size_t i : {0u, 6u, 12u, 18u, 25u, 31u, 38u, 44u, 50u})
      out << "<text x='" << panel.x(i) - 8 << "' y='" << kTop + kHigh + 16 << "'>" << 2 * i
          << "</text>\n";
    for (std::size_t c = 0; c < curves.size(); ++c) {
      out << "<polyline fill='none' stroke-width='2' stroke='" << kColors[c % kColors.size()]
          << "' points='";
      for (std::size_t i = 0; i < 51; ++i)
        out << panel.x(i) << ',' << panel.y(curve_of(*curves[c].curves, p)[i]) << ' ';
      out << "'/>\n<text x='" << kLeft + 260 + 90 * static_cast<float>(c) << "' y='24' fill='"
          << kColors[c % kColors.size()] << "'>" << curves[c].name << "</text>\n";
    }
    out << "<text x='" << kLeft << "' y='24'>" << panel.title << "</text></g>\n";
  }
  out << "<text x='" << kLeft << "' y='" << kPanels.size() * (kHigh + 80)
      << "'>percent of the cycle from heel strike; grey: norm and two standard deviations "
         "(Schwartz 2008)</text></svg>\n";
  return out.str();
}

}  // namespace caryatid::bake
