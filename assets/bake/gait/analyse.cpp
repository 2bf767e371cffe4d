#include "assets/bake/gait/analyse.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "assets/bake/gait/measure.h"
#include "assets/bake/gait/normative.h"
#include "assets/bake/gait/settled_walk.h"
#include "core/body/walker.h"

namespace caryatid::bake {
namespace {

constexpr float kDegrees = 57.2957795f;
using Series = std::vector<float>;

// What the rules look at, frame by frame; index [side].
struct Signals {
  std::array<Series, 2> ankle_ahead;  // Of the pelvis.
  std::array<Series, 2> toe_ahead;
  std::array<Series, 2> thigh, knee, foot_pitch, list, rotation;
  std::array<Series, 2> toe_height, ankle_height;
  Series trunk_pitch, head_pitch;
  std::array<Series, 2> arm, elbow;
};

Series smoothed(const Series& in, float fps) {
  const int half = std::max(1, static_cast<int>(0.05f * fps - 0.5f));
  Series out(in.size());
  for (int i = 0; i < static_cast<int>(in.size()); ++i) {
    const int a = std::max(0, i - half), b = std::min(static_cast<int>(in.size()) - 1, i + half);
    float sum = 0.0f;
    for (int k = a; k <= b; ++k) sum += in[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(i)] = sum / static_cast<float>(b - a + 1);
  }
  return out;
}

Vec3 level(Vec3 v) { return {v.x, 0.0f, v.z}; }

// Direction of walking: of the travel about the frame, or the hips' facing where there is none.
Vec3 direction(const Motion& m, std::size_t i) {
  const auto reach = static_cast<std::size_t>(0.5f * m.fps);
  const std::size_t a = i > reach ? i - reach : 0;
  const std::size_t b = std::min(m.frames.size() - 1, i + reach);
  const Vec3 travel = level(m.frames[b].pelvis - m.frames[a].pelvis);
  if (glm::length(travel) > 0.15f) return glm::normalize(travel);
  const Vec3 across = level(m.frames[i].side[0].hip - m.frames[i].side[1].hip);
  return glm::normalize(glm::cross(across, Vec3{0, 1, 0}));
}

Signals signals_of(const Motion& m) {
  Signals s;
  for (std::size_t i = 0; i < m.frames.size(); ++i) {
    const MotionFrame& f = m.frames[i];
    const Vec3 ahead = direction(m, i);
    const auto forward = [&](Vec3 v) { return std::atan2(glm::dot(v, ahead), -v.y) * kDegrees; };
    for (std::size_t k = 0; k < 2; ++k) {
      const MotionFrame::Side& leg = f.side[k];
      const float thigh = forward(leg.knee - leg.hip);
      s.thigh[k].push_back(thigh);
      s.knee[k].push_back(thigh - forward(leg.ankle - leg.knee));
      const PelvisTurn pelvis = pelvis_turn(leg.hip, f.side[1 - k].hip, ahead);
      s.list[k].push_back(pelvis.list);
      s.rotation[k].push_back(pelvis.rotation);
      const Vec3 foot = leg.toe - leg.ankle;
      s.foot_pitch[k].push_back(std::atan2(foot.y, glm::dot(foot, ahead)) * kDegrees);
      s.ankle_ahead[k].push_back(glm::dot(leg.ankle - f.pelvis, ahead));
      s.toe_ahead[k].push_back(glm::dot(leg.toe - f.pelvis, ahead));
      s.toe_height[k].push_back(leg.toe.y);
      s.ankle_height[k].push_back(leg.ankle.y);
      if (m.has_arms) {
        const float upper = forward(leg.elbow - leg.shoulder);
        s.arm[k].push_back(upper);
        s.elbow[k].push_back(std::acos(std::clamp(glm::dot(glm::normalize(leg.elbow - leg.shoulder),
                                                           glm::normalize(leg.wrist - leg.elbow)),
                                                  -1.0f, 1.0f)) *
                             kDegrees);
      }
    }
    const Vec3 trunk = f.neck - f.pelvis;
    s.trunk_pitch.push_back(std::atan2(glm::dot(trunk, ahead), trunk.y) * kDegrees);
    const Vec3 head = f.head - f.neck;
    s.head_pitch.push_back(std::atan2(glm::dot(head, ahead), head.y) * kDegrees);
  }
  for (auto* pair : {&s.ankle_ahead, &s.toe_ahead, &s.thigh, &s.knee, &s.foot_pitch})
    for (Series& series : *pair) series = smoothed(series, m.fps);
  return s;
}

// Feet that are farthest ahead: maxima that rise above both neighbours' lowest by a third of the
// whole range, with the frames of the file's ends left out.
std::vector<std::size_t> strikes(const Series& ahead, float fps) {
  std::vector<std::size_t> found;
  const auto [low, high] = std::minmax_element(ahead.begin(), ahead.end());
  const float needed = *low + 0.65f * (*high - *low);
  const auto reach = static_cast<std::size_t>(std::max(2.0f, 0.2f * fps));
  if (*high - *low < 0.08f) return found;  // Stands.
  for (std::size_t i = 1; i + 1 < ahead.size(); ++i) {
    const std::size_t a = i > reach ? i - reach : 0, b = std::min(ahead.size() - 1, i + reach);
    const bool highest =
        *std::max_element(ahead.begin() + static_cast<std::ptrdiff_t>(a),
                          ahead.begin() + static_cast<std::ptrdiff_t>(b) + 1) <= ahead[i];
    if (highest && ahead[i] >= needed && ahead[i] > ahead[i - 1]) found.push_back(i);
  }
  return found;
}

// The extremum of a window of the stride, percent of it; nominal when it lies on the border.
GaitPhase extremum(const Series& series, const Stride& stride, float from, float to, float sign,
                   float nominal) {
  const float span = static_cast<float>(stride.end - stride.begin);
  const auto frame = [&](float percent) {
    return stride.begin + static_cast<std::size_t>(std::lround(percent * 0.01f * span));
  };
  const std::size_t a = frame(from), b = std::min(frame(to), series.size() - 1);
  std::size_t best = a;
  for (std::size_t i = a; i <= b; ++i)
    if (sign * series[i] > sign * series[best]) best = i;
  if (best == a || best == b) return {nominal, true};
  // A parabola through the neighbours places it between frames.
  const float y0 = series[best - 1], y1 = series[best], y2 = series[best + 1];
  const float bend = y0 - 2.0f * y1 + y2;
  const float shift = std::abs(bend) > 1e-9f ? 0.5f * (y0 - y2) / bend : 0.0f;
  return {(static_cast<float>(best - stride.begin) + shift) / span * 100.0f, false};
}

// A foot is off the floor when both its toe and its ankle are well above their lowest.
bool any_flight(const Motion& m, const Signals& s) {
  constexpr float kToe = 0.03f, kAnkle = 0.05f;
  const auto lowest = [](Series x) {  // The floor, as the standing foot feels it.
    std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 5), x.end());
    return x[x.size() / 5];
  };
  const std::array<float, 2> toe = {lowest(s.toe_height[0]), lowest(s.toe_height[1])};
  const std::array<float, 2> ankle = {lowest(s.ankle_height[0]), lowest(s.ankle_height[1])};
  std::size_t flying = 0;
  for (std::size_t i = 0; i < m.frames.size(); ++i) {
    bool up = true;
    for (std::size_t k = 0; k < 2; ++k)
      up = up && s.toe_height[k][i] > toe[k] + kToe && s.ankle_height[k][i] > ankle[k] + kAnkle;
    flying += up ? 1 : 0;
  }
  return flying * 20 > m.frames.size();  // More than 5 % of the time.
}

float sample(const Series& series, const Stride& stride, float percent) {
  const float at = static_cast<float>(stride.begin) +
                   percent * 0.01f * static_cast<float>(stride.end - stride.begin);
  const auto i = static_cast<std::size_t>(at);
  const std::size_t j = std::min(i + 1, series.size() - 1);
  const float u = at - static_cast<float>(i);
  return series[i] * (1.0f - u) + series[j] * u;
}

// The level that a foot has when it stands flat: its pitch in the middle of stance.
float flat_pitch(const Signals& s, const std::vector<Stride>& strides) {
  float sum = 0.0f;
  for (const Stride& t : strides) sum += sample(s.foot_pitch[t.left ? 0 : 1], t, 22.0f);
  return sum / static_cast<float>(strides.size());
}

CycleCurves mean_curves(const Signals& s, const std::vector<Stride>& strides) {
  CycleCurves c;
  const float flat = flat_pitch(s, strides);
  const float n = static_cast<float>(strides.size());
  for (const Stride& t : strides) {
    const std::size_t k = t.left ? 0 : 1;
    for (std::size_t i = 0; i < c.thigh.size(); ++i) {
      const float percent = 2.0f * static_cast<float>(i);
      const float thigh = sample(s.thigh[k], t, percent), knee = sample(s.knee[k], t, percent);
      c.thigh[i] += thigh / n;
      c.knee[i] += knee / n;
      c.list[i] += sample(s.list[k], t, percent) / n;
      c.rotation[i] += sample(s.rotation[k], t, percent) / n;
      c.ankle[i] += (sample(s.foot_pitch[k], t, percent) - flat - thigh + knee) / n;
    }
  }
  return c;
}

float mean_of(const Series& s) {
  return s.empty() ? 0.0f
                   : std::accumulate(s.begin(), s.end(), 0.0f) / static_cast<float>(s.size());
}

float at_percent(const std::array<float, 51>& curve, float percent) {
  const float at = percent / 2.0f;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), 49);
  const float u = at - static_cast<float>(i);
  return curve[i] * (1.0f - u) + curve[i + 1] * u;
}

// Key poses at the thesis's instants, bearing from the means.
body::GaitStyle style_of(const Motion& m, const Signals& s, const GaitAnalysis& a) {
  body::GaitStyle style = a.runs ? body::running_style() : body::gait_style(body::GaitMood::normal);
  // Joint centres of captures do not read 0 on a straight leg: the least knee angle counts as 3.
  const float bent = *std::min_element(a.measured.knee.begin(), a.measured.knee.end());
  const float knee_zero = a.runs ? 9.0f : std::clamp(bent - 3.0f, 0.0f, 12.0f);
  for (std::size_t k = 0; k < 4; ++k) {
    const float early = 12.5f * static_cast<float>(k), late = early + 50.0f;
    const auto thigh = [&](float p) { return at_percent(a.measured.thigh, p); };
    const auto knee = [&](float p) { return at_percent(a.measured.knee, p) - knee_zero; };
    const auto ankle = [&](float p) { return at_percent(a.measured.ankle, p) - knee_zero; };
    style.stance_thigh_deg[k] = thigh(early) - 0.5f * knee_zero;
    style.swing_thigh_deg[k] = thigh(late) - 0.5f * knee_zero;
    style.stance_knee_deg[k] = knee(early);
    style.swing_knee_deg[k] = knee(late);
    style.stance_ankle_deg[k] = ankle(early);
    style.swing_ankle_deg[k] = ankle(late);
  }
  float seconds = 0.0f, contact = 0.0f;
  for (const Stride& t : a.strides) {
    seconds += t.seconds / static_cast<float>(a.strides.size());
    contact += t.toe_off.percent * 0.01f / static_cast<float>(a.strides.size());
  }
  style.cycle_s = seconds;
  // The rule for toe-off is one of walking; a run keeps the style's share of contact.
  if (!a.runs) style.contact = std::clamp(contact, 0.58f, 0.66f);
  if (m.has_trunk) style.trunk_pitch_deg = mean_of(s.trunk_pitch);
  if (m.has_arms) {
    const auto ends = [](const Series& x) { return std::minmax_element(x.begin(), x.end()); };
    const auto [l0, l1] = ends(s.arm[0]);
    const auto [r0, r1] = ends(s.arm[1]);
    style.arm_back_deg = 0.5f * (*l0 + *r0);
    style.arm_forward_deg = 0.5f * (*l1 + *r1);
    const auto [e0, e1] = ends(s.elbow[0]);
    const auto [f0, f1] = ends(s.elbow[1]);
    style.elbow_back_deg = 0.5f * (*e0 + *f0);
    style.elbow_forward_deg = 0.5f * (*e1 + *f1);
  }
  return style;
}

// What tells moods apart in a capture, each in units of its usual spread between moods.
std::vector<float> features(const body::GaitStyle& g, const Motion& m) {
  // Knees against their straightest: captures differ in where a joint centre sits.
  float straight = g.stance_knee_deg[0];
  for (const auto* keys : {&g.stance_knee_deg, &g.swing_knee_deg})
    for (const float knee : *keys) straight = std::min(straight, knee);
  std::vector<float> f = {g.cycle_s / 0.2f, (g.stance_thigh_deg[0] - g.swing_thigh_deg[0]) / 8.0f,
                          (g.swing_knee_deg[2] - straight) / 8.0f,
                          (g.stance_knee_deg[2] - straight) / 6.0f};
  if (m.has_trunk) f.push_back(g.trunk_pitch_deg / 6.0f);
  if (m.has_arms) {
    f.push_back((g.arm_forward_deg - g.arm_back_deg) / 18.0f);
    f.push_back(g.elbow_forward_deg / 25.0f);
  }
  return f;
}

// All but the mood and the resynthesis.
GaitAnalysis measured_gait(const Motion& m) {
  GaitAnalysis a;
  if (m.frames.size() < 8) throw std::runtime_error("fewer than 8 frames; no stride fits");
  const Signals s = signals_of(m);
  for (std::size_t k = 0; k < 2; ++k) {
    a.heel_strikes[k] = strikes(s.ankle_ahead[k], m.fps);
    const std::vector<std::size_t>& at = a.heel_strikes[k];
    for (std::size_t i = 1; i < at.size(); ++i) {
      Stride t{.left = k == 0,
               .begin = at[i - 1],
               .end = at[i],
               .recoil = {},
               .passing = {},
               .anticipation = {},
               .toe_off = {}};
      t.seconds = static_cast<float>(t.end - t.begin) / m.fps;
      if (t.seconds < 0.4f || t.seconds > 2.5f) continue;
      t.length_m = glm::length(level(m.frames[t.end].pelvis - m.frames[t.begin].pelvis));
      const std::size_t other = 1 - k;
      t.recoil = extremum(s.knee[k], t, 5, 25, 1.0f, 12.5f);
      t.passing = extremum(s.knee[other], t, 8, 45, 1.0f, 25.0f);
      t.anticipation = extremum(s.thigh[other], t, 28, 56, 1.0f, 37.5f);
      t.toe_off = extremum(s.toe_ahead[k], t, 25, 80, -1.0f, 61.0f);
      a.strides.push_back(t);
    }
  }
  if (a.strides.empty()) throw std::runtime_error("no whole stride found; is this a walk?");
  a.runs = any_flight(m, s);
  float seconds = 0.0f, metres = 0.0f;
  for (const Stride& t : a.strides) {
    seconds += t.seconds;
    metres += t.length_m;
  }
  a.speed_mps = metres / seconds;
  a.cadence_spm = 120.0f * static_cast<float>(a.strides.size()) / seconds;
  a.measured = mean_curves(s, a.strides);
  a.style = style_of(m, s, a);
  return a;
}

// The moods as they look when measured like a capture: on walks of our generic body.
const std::vector<body::GaitStyle>& mood_references() {
  static const std::vector<body::GaitStyle> references = [] {
    constexpr float kFps = 60.0f;
    const body::Skeleton s = body::upright_skeleton();
    std::vector<body::GaitStyle> found;
    for (int g = 0; g < body::kGaitMoodCount; ++g) {
      SettledWalk walk(s, body::gait_style(body::GaitMood(g)));
      found.push_back(measured_gait(motion_of(s, walk.record(300, kFps), kFps)).style);
    }
    return found;
  }();
  return references;
}

}  // namespace

GaitAnalysis analyse_gait(const Motion& m) {
  GaitAnalysis a = measured_gait(m);
  const std::vector<float> own = features(a.style, m);
  for (std::size_t g = 0; g < a.mood_distance.size(); ++g) {
    const std::vector<float> theirs = features(mood_references()[g], m);
    float sum = 0.0f;
    for (std::size_t i = 0; i < own.size(); ++i) sum += (own[i] - theirs[i]) * (own[i] - theirs[i]);
    a.mood_distance[g] = std::sqrt(sum / static_cast<float>(own.size()));
  }
  a.mood = body::GaitMood(std::min_element(a.mood_distance.begin(), a.mood_distance.end()) -
                          a.mood_distance.begin());
  a.resynthesised = walked_curves(a.style);
  float thigh = 0.0f, knee = 0.0f;
  for (std::size_t i = 0; i < 51; ++i) {
    thigh += std::pow(a.resynthesised.thigh[i] - a.measured.thigh[i], 2.0f);
    knee += std::pow(a.resynthesised.knee[i] - a.measured.knee[i], 2.0f);
  }
  a.thigh_rms_deg = std::sqrt(thigh / 51.0f);
  a.knee_rms_deg = std::sqrt(knee / 51.0f);
  return a;
}

CycleCurves walked_curves(const body::GaitStyle& style, body::GaitInterpolation interpolation) {
  const body::Skeleton s = body::upright_skeleton();
  body::Walker walker(&s);
  walker.set_style(style);
  walker.set_interpolation(interpolation);
  walker.walk_to({0, 1000});
  body::BapFrame frame;
  const auto right_phase = [&] { return std::fmod(walker.left_phase() + 0.5f, 1.0f); };
  for (int i = 0; i < 300; ++i) walker.step(1.0f / 30.0f, frame);
  const float tick = style.cycle_s / 1000.0f;
  float before = right_phase();
  for (int i = 0; i < 3000; ++i) {  // To a heel strike of the right foot.
    walker.step(tick, frame);
    const float now = right_phase();
    if (now < before) break;
    before = now;
  }
  CycleCurves c;
  float at = right_phase();
  for (std::size_t i = 0; i < 51; ++i) {
    const float wanted = 0.02f * static_cast<float>(i);
    for (int k = 0; k < 40 && at < wanted; ++k) {
      walker.step(tick, frame);
      const float now = right_phase();
      at = now < at - 0.5f ? now + 1.0f : now;
    }
    const LegAngles angles = leg_angles(s, frame, false);
    c.thigh[i] = angles.thigh;
    c.knee[i] = angles.knee;
    c.ankle[i] = angles.ankle;
    c.list[i] = angles.list;
    c.rotation[i] = angles.rotation;
  }
  return c;
}

NormativeFit fit_to_norm(const CycleCurves& c) {
  NormativeFit fit;
  for (std::size_t i = 0; i < 51; ++i) {
    const NormativeRow& n = normative_walk()[i];
    const float hip = c.thigh[i] + n.pelvis_tilt;
    const auto within = [](float value, float mean, float sd) {
      return std::abs(value - mean) <= 2.0f * sd ? 1.0f / 51.0f : 0.0f;
    };
    fit.hip += within(hip, n.hip, n.hip_sd);
    fit.knee += within(c.knee[i], n.knee, n.knee_sd);
    fit.ankle += within(c.ankle[i], n.ankle, n.ankle_sd);
    fit.list += within(c.list[i], n.list, n.list_sd);
    fit.rotation += within(c.rotation[i], n.rotation, n.rotation_sd);
  }
  return fit;
}

std::string report_json(const GaitAnalysis& a) {
  using nlohmann::json;
  const auto phase = [](const GaitPhase& p) {
    return json{{"percent", p.percent}, {"nominal", p.nominal}};
  };
  json strides = json::array();
  for (const Stride& t : a.strides)
    strides.push_back({{"leg", t.left ? "left" : "right"},
                       {"frames", {t.begin, t.end}},
                       {"seconds", t.seconds},
                       {"length_m", t.length_m},
                       {"recoil", phase(t.recoil)},
                       {"passing", phase(t.passing)},
                       {"anticipation", phase(t.anticipation)},
                       {"stance_percent", phase(t.toe_off)}});
  json moods;
  for (std::size_t g = 0; g < a.mood_distance.size(); ++g)
    moods[body::gait_mood_name(body::GaitMood(g))] = a.mood_distance[g];
  const body::GaitStyle& s = a.style;
  const json style = {{"cycle_s", s.cycle_s},
                      {"stance_thigh_deg", s.stance_thigh_deg},
                      {"stance_knee_deg", s.stance_knee_deg},
                      {"stance_ankle_deg", s.stance_ankle_deg},
                      {"swing_thigh_deg", s.swing_thigh_deg},
                      {"swing_knee_deg", s.swing_knee_deg},
                      {"swing_ankle_deg", s.swing_ankle_deg},
                      {"trunk_pitch_deg", s.trunk_pitch_deg},
                      {"arm_deg", {s.arm_back_deg, s.arm_forward_deg}},
                      {"elbow_deg", {s.elbow_back_deg, s.elbow_forward_deg}}};
  const json report = {
      {"gait", a.runs ? "run" : "walk"},
      {"speed_mps", a.speed_mps},
      {"cadence_steps_per_min", a.cadence_spm},
      {"heel_strikes", {{"left", a.heel_strikes[0]}, {"right", a.heel_strikes[1]}}},
      {"strides", strides},
      {"style", style},
      {"nearest_mood", body::gait_mood_name(a.mood)},
      {"mood_distance", moods},
      {"resynthesis", {{"thigh_rms_deg", a.thigh_rms_deg}, {"knee_rms_deg", a.knee_rms_deg}}}};
  return report.dump(2) + "\n";
}

}  // namespace caryatid::bake
