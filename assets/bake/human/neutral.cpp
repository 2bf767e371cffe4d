#include "assets/bake/human/neutral.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <queue>
#include <stdexcept>

#include "assets/bake/face/open_lids.h"
#include "assets/bake/human/inner_face.h"
#include "assets/bake/human/mesh_tools.h"

namespace caryatid::bake {
namespace {

// Distance along edges from a set of seeds, up to a limit (Dijkstra), and the seed that is nearest.
struct Reach {
  std::vector<float> distance_m;
  std::vector<std::uint32_t> seed;
};
Reach reach_from(const std::vector<std::vector<std::uint32_t>>& neighbours,
                 const std::vector<Vec3>& p, const std::vector<std::uint32_t>& seeds,
                 float limit_m) {
  Reach r{std::vector<float>(p.size(), 1e9f), std::vector<std::uint32_t>(p.size(), kNone)};
  using Item = std::pair<float, std::uint32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (const std::uint32_t s : seeds) {
    r.distance_m[s] = 0.0f;
    r.seed[s] = s;
    queue.push({0.0f, s});
  }
  while (!queue.empty()) {
    const auto [d, v] = queue.top();
    queue.pop();
    if (d > r.distance_m[v] || d > limit_m) continue;
    for (const std::uint32_t n : neighbours[v]) {
      const float through = d + glm::length(p[n] - p[v]);
      if (through >= r.distance_m[n]) continue;
      r.distance_m[n] = through;
      r.seed[n] = r.seed[v];
      queue.push({through, n});
    }
  }
  return r;
}

// The inner contour of one lip, right corner to left, by x: the skin vertices that face the other
// lip in front of the teeth. Found by walking from the middle point to both corners along the edges
// that keep nearest to the line between the lips.
std::vector<std::uint32_t> lip_contour(const std::vector<std::vector<std::uint32_t>>& neighbours,
                                       const std::vector<Vec3>& p, std::uint32_t middle,
                                       std::uint32_t quarter, std::uint32_t corner) {
  std::vector<std::uint32_t> out;
  std::uint32_t at = middle;
  for (int step = 0; step < 40 && at != corner; ++step) {
    out.push_back(at);
    // Aim at the quarter point first, then at the corner; always outwards.
    const Vec3 aim = std::abs(p[at].x) < std::abs(p[quarter].x) - 1e-5f ? p[quarter] : p[corner];
    std::uint32_t best = kNone;
    float best_cost = 1e9f;
    for (const std::uint32_t n : neighbours[at]) {
      if (std::abs(p[n].x) <= std::abs(p[at].x) + 1e-6f && n != corner) continue;
      // Never past the corner: from there the walk would go on over the cheek.
      if (std::abs(p[n].x) > std::abs(p[corner].x) - 1e-5f && n != corner) continue;
      const Vec3 to = glm::normalize(aim - p[at]), go = glm::normalize(p[n] - p[at]);
      if (const float cost = 1.0f - glm::dot(to, go); cost < best_cost) best_cost = cost, best = n;
    }
    if (best == kNone) break;
    at = best;
  }
  out.push_back(corner);
  return out;
}

// Height of a contour at some |x|, linear between its vertices.
float height_at(const std::vector<Vec3>& p, const std::vector<std::uint32_t>& contour, float x) {
  for (std::size_t i = 1; i < contour.size(); ++i) {
    const Vec3 a = p[contour[i - 1]], b = p[contour[i]];
    if (std::abs(b.x) < x && i + 1 < contour.size()) continue;
    const float span = std::abs(b.x) - std::abs(a.x);
    const float t = span > 1e-6f ? std::clamp((x - std::abs(a.x)) / span, 0.0f, 1.0f) : 0.0f;
    return a.y + (b.y - a.y) * t;
  }
  return p[contour.back()].y;
}

// Where two lips meet at some |x|: midway, evened out along the line, for a bow with a point in the
// middle becomes a notch as soon as the lips part.
float meeting_at(const std::vector<Vec3>& p, const std::vector<std::uint32_t>& upper,
                 const std::vector<std::uint32_t>& lower, float x) {
  constexpr float kWindow_m = 0.012f;
  constexpr int kSamples = 8;
  const float end = std::abs(p[upper.back()].x);
  // No wider than the way to the corner, which stays.
  const float window = std::min(kWindow_m, end - x);
  float sum = 0.0f, weights = 0.0f;
  for (int i = -kSamples; i <= kSamples; ++i) {
    const float t = static_cast<float>(i) / (kSamples + 1);
    const float at = std::abs(x + t * window), weight = 1.0f - std::abs(t);
    sum += weight * 0.5f * (height_at(p, upper, at) + height_at(p, lower, at));
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

void settle_neutral(const BaseHuman& base, const std::vector<FeaturePointPlace>& places,
                    float iris_diameter_m, std::vector<Vec3>& p) {
  fat::LidPoints lid_points;
  for (const int index : {1, 2, 3, 4}) lid_points[{3, index}] = base_vertex_of(places, 3, index);
  for (const int index : {1, 2, 3, 4, 5, 6})
    lid_points[{4, index}] = base_vertex_of(places, 4, index);
  fat::open_lids(base, lid_points, iris_diameter_m, p);

  std::vector<Quad> skin;
  for (const Quad& quad : base.quads())
    if (quad.group == 0) skin.push_back(quad);
  const auto neighbours = edge_neighbours(skin, p.size());
  const auto vertex = [&](int group, int index) { return base_vertex_of(places, group, index); };
  // Per lip: contour on both sides, and what lifts it to the line where the lips meet: the height
  // of the corners in the middle of the gap, following the bow of the lips.
  std::vector<std::uint32_t> upper, lower;
  std::vector<float> move(p.size(), 0.0f);
  for (int side = 0; side < 2; ++side) {
    const std::uint32_t corner = vertex(2, side == 0 ? 4 : 5);
    const auto u = lip_contour(neighbours, p, vertex(2, 2), vertex(2, side == 0 ? 6 : 7), corner);
    const auto l = lip_contour(neighbours, p, vertex(2, 3), vertex(2, side == 0 ? 8 : 9), corner);
    for (const auto* contour : {&u, &l})
      for (std::size_t i = 0; i + 1 < contour->size(); ++i) {
        const std::uint32_t v = (*contour)[i];
        const float x = std::abs(p[v].x);
        const float meet = meeting_at(p, u, l, x);
        // A tenth of a millimetre of overlap seals the line.
        move[v] = meet - p[v].y + (contour == &u ? -5e-5f : 5e-5f);
        (contour == &u ? upper : lower).push_back(v);
      }
  }
  constexpr float kFade_m = 0.011f;
  const Reach of_upper = reach_from(neighbours, p, upper, kFade_m);
  const Reach of_lower = reach_from(neighbours, p, lower, kFade_m);
  for (std::uint32_t v = 0; v < p.size(); ++v) {
    // Each lip goes with its own contour; where both reach, behind the corners, the nearer one
    // wins.
    const Reach& r = of_upper.distance_m[v] <= of_lower.distance_m[v] ? of_upper : of_lower;
    if (r.distance_m[v] >= kFade_m) continue;
    const float t = 1.0f - r.distance_m[v] / kFade_m;
    p[v].y += move[r.seed[v]] * t * t * (3.0f - 2.0f * t);
  }
}

void check_inner_face(const Character& c) {
  const auto broken = [&](const std::string& rule, float value, float wanted, float allowed,
                          const char* unit) {
    if (std::abs(value - wanted) <= allowed) return;
    char text[200];
    std::snprintf(text, sizeof text, "%s: neutral face: %s is %.2f%s, wanted %.2f +- %.2f",
                  c.name.c_str(), rule.c_str(), double(value), unit, double(wanted),
                  double(allowed));
    throw std::runtime_error(text);
  };
  constexpr float kDegrees = 57.29578f, kMillimetres = 1000.0f;
  for (int side = 0; side < 2; ++side) {
    const IrisMeasure eye = measure_iris(c, side);
    const std::string name = side == 0 ? "left " : "right ";
    broken(name + "pupil over iris", eye.pupil_diameter_m / eye.iris_diameter_m, 1.0f / 3.0f, 0.05f,
           "");
    broken(name + "gaze off +Z",
           kDegrees * std::atan2(glm::length(Vec2(eye.pupil_m)), eye.pupil_m.z), 0.0f, 1.5f,
           " degrees");
  }
  const TongueMeasure tongue = measure_tongue(c);
  broken("tip of the tongue from the teeth", kMillimetres * tongue.tip_to_teeth_m, 0.0f, 0.8f,
         " mm");
  broken("tip of the tongue over the bite", kMillimetres * tongue.above_bite_m, 0.0f, 1.5f, " mm");
  broken("tongue's incline", kDegrees * tongue.incline_rad, 0.0f, 20.0f, " degrees");
  broken("tongue's roll", kDegrees * tongue.roll_rad, 0.0f, 2.0f, " degrees");
}

void check_neutral(const Character& c, float iris_diameter_m) {
  const auto at = [&](int group, int index) {
    for (const FeaturePoint& f : c.feature_points)
      if (f.group == group && f.index == index) return f.position_m;
    throw std::runtime_error("the neutral face can't be measured: a feature point is missing");
  };
  const auto broken = [&](const char* rule, float value_m, float allowed_m) {
    if (std::abs(value_m) <= allowed_m) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s: neutral face: %s off by %.2f mm, allowed %.2f mm",
                  c.name.c_str(), rule, 1e3 * double(value_m), 1e3 * double(allowed_m));
    throw std::runtime_error(text);
  };
  broken("lips touching (2.2 - 2.3)", at(2, 2).y - at(2, 3).y, 0.0005f);
  broken("lips touching left (2.6 - 2.8)", at(2, 6).y - at(2, 8).y, 0.0009f);
  broken("corners level (2.4 - 2.5)", at(2, 4).y - at(2, 5).y, 0.0005f);
  broken("lip line at corner height", at(2, 2).y - at(2, 4).y, 0.004f);
  broken("lid openings alike", (at(3, 1).y - at(3, 3).y) - (at(3, 2).y - at(3, 4).y), 0.0005f);
  broken("lids tangent to the iris", c.facts.iris_diameter_m - iris_diameter_m, 0.0006f);
  broken("eyes level", at(3, 5).y - at(3, 6).y, 0.0005f);
  check_inner_face(c);
}

}  // namespace caryatid::bake
