#include "assets/bake/head/openings.h"

#include <algorithm>
#include <cmath>

#include "assets/bake/face/smooth.h"
#include "assets/bake/head/skin_edit.h"

namespace caryatid::bake::foreign {
namespace {

using fat::kLipColumns;
using fat::kLipCorner;
using fat::kSides;

constexpr float kShallow_m = 0.004f;  // What fills an opening lies no deeper behind its edge.

Chain joined(Chain a, const Chain& b) {
  a.insert(a.end(), b.begin() + (a.empty() || b.empty() ? 0 : 1), b.end());
  return a;
}

// The way through all of the points in turn, which never comes to one place twice.
Chain way_through(const PointList& points, const PlacedHead& head, const SurfaceGraph& graph,
                  const std::vector<PointId>& through, std::vector<bool> barred = {}) {
  Chain out;
  barred.resize(head.position_m.size(), false);
  for (std::size_t i = 1; i < through.size(); ++i) {
    for (const std::uint32_t v : out) barred[v] = true;
    if (i > 1 && barred[head.vertex.at(through[i])])
      points.fail(points.find(through[i]),
                  "the line to point " + name_of(through[i]) +
                      " comes by it too early; check the points beside it");
    const Chain leg = graph.way(head.vertex.at(through[i - 1]), head.vertex.at(through[i]), barred);
    if (leg.empty())
      points.fail(points.find(through[i]), "there is no way along the skin from point " +
                                               name_of(through[i - 1]) + " to " +
                                               name_of(through[i]) + "; check both");
    out = joined(std::move(out), leg);
  }
  return out;
}

std::vector<bool> inner_marks(std::size_t size, const Chain& chain) {
  std::vector<bool> mark(size, false);
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) mark[chain[i]] = true;
  return mark;
}

Chain loop_of(const Chain& there, const Chain& other) {
  Chain loop = there;
  loop.insert(loop.end(), other.rbegin() + 1, other.rend() - 1);
  return loop;
}

// What a closed chain on the skin encloses: marked triangles, and how deep they lie behind it.
struct Enclosed {
  std::vector<bool> triangle;
  bool any = false;
  float depth_m = 0;
};
Enclosed enclosed_by(const PlacedHead& head, const Chain& loop, float within_m) {
  Enclosed out{outside_of(head, loop, head.vertex.at({9, 3})), false, 0};
  out.triangle.flip();
  Vec3 middle{0};
  for (const std::uint32_t v : loop) middle += head.position_m[v];
  middle /= static_cast<float>(loop.size());
  float depth = 0, area = 0;
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    if (!out.triangle[t]) continue;
    const auto& [i, j, k] = head.triangles[t];
    const Vec3 a = head.position_m[i], b = head.position_m[j], c = head.position_m[k];
    const Vec3 center = (a + b + c) / 3.0f;
    out.triangle[t] = glm::length(center - middle) < within_m;
    if (!out.triangle[t]) continue;
    out.any = true;
    const float weight = glm::length(glm::cross(b - a, c - a));
    depth += weight * (middle.z - center.z);
    area += weight;
  }
  out.depth_m = area > 0 ? depth / area : 0;
  return out;
}

void set_zone(Openings& out, const PlacedHead& head, Zone zone) {
  out.zone.resize(head.position_m.size(), zone);
}

// --- Eyes ---

struct EyeIds {
  int upper, lower, outer, inner;
};
constexpr EyeIds kEyeIds[kSides] = {{1, 3, 7, 11}, {2, 4, 12, 8}};

// The loose part that is this eye's ball: about as large as an eyeball, behind the lids.
bool find_ball(const PlacedHead& head, Vec3 lids_m, std::size_t* ball) {
  constexpr float kSmallest_m = 0.012f, kLargest_m = 0.045f;
  float best = 0.022f;  // Farthest that its centre lies from the lids.
  bool found = false;
  for (std::size_t p = 0; p < head.parts.size(); ++p) {
    const LoosePart& part = head.parts[p];
    const Vec3 size = part.high_m - part.low_m;
    const float width = std::max(size.x, size.y);
    const Vec3 from = part.center_m() - lids_m;
    if (width < kSmallest_m || width > kLargest_m || size.y < 0.6f * size.x) continue;
    if (from.z > 0.004f || glm::length(from) >= best) continue;
    best = glm::length(from);
    *ball = p;
    found = true;
  }
  return found;
}

// An eyeball of a human's size that lies against the lids from behind.
void fit_ball(const PlacedHead& head, fat::Eye& eye, const Chain& loop) {
  constexpr float kRadius_m = 0.0122f, kAir_m = 0.0004f;
  Vec3 low{1e9f}, high{-1e9f};
  for (const std::uint32_t v : loop) {
    low = glm::min(low, head.position_m[v]);
    high = glm::max(high, head.position_m[v]);
  }
  eye.ball_radius_m = std::clamp(0.46f * (high.x - low.x), 0.8f * kRadius_m, 1.1f * kRadius_m);
  eye.center_m = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), high.z};
  const float clear = eye.ball_radius_m + kAir_m;
  const auto pass_behind = [&](Vec3 p) {
    const float dx = p.x - eye.center_m.x, dy = p.y - eye.center_m.y;
    const float square = clear * clear - dx * dx - dy * dy;
    if (square > 0) eye.center_m.z = std::min(eye.center_m.z, p.z - std::sqrt(square));
  };
  for (std::size_t i = 0; i < loop.size(); ++i) {  // Vertices and chords between them.
    const Vec3 a = head.position_m[loop[i]], b = head.position_m[loop[(i + 1) % loop.size()]];
    for (const float t : {0.0f, 0.5f}) pass_behind(glm::mix(a, b, t));
  }
}

void sort_rim(const PlacedHead& head, const Chain& upper, const Chain& lower, fat::Eye& eye) {
  const auto by_x = [&](std::uint32_t a, std::uint32_t b) {
    return head.position_m[a].x < head.position_m[b].x;
  };
  eye.rim = loop_of(upper, lower);
  eye.upper.assign(upper.begin() + 1, upper.end() - 1);
  eye.lower.assign(lower.begin() + 1, lower.end() - 1);
  std::sort(eye.upper.begin(), eye.upper.end(), by_x);
  std::sort(eye.lower.begin(), eye.lower.end(), by_x);
}

void open_eye(const PointList& points, PlacedHead& head, int side, Openings& out) {
  const EyeIds& ids = kEyeIds[side];
  const auto s = static_cast<std::size_t>(side);
  const SurfaceGraph graph(head.position_m, head.triangles);
  const Chain upper =
      way_through(points, head, graph, {{3, ids.outer}, {3, ids.upper}, {3, ids.inner}});
  const Chain lower =
      way_through(points, head, graph, {{3, ids.outer}, {3, ids.lower}, {3, ids.inner}},
                  inner_marks(head.position_m.size(), upper));
  fat::Eye& eye = out.eye[s];
  sort_rim(head, upper, lower, eye);
  const Vec3 lids = 0.5f * (head.at(3, ids.upper) + head.at(3, ids.lower));
  out.own_ball[s] = find_ball(head, lids, &out.ball[s]);
  if (out.own_ball[s]) {
    const LoosePart& ball = head.parts[out.ball[s]];
    const Vec3 size = ball.high_m - ball.low_m;
    eye.ball_radius_m = 0.5f * std::max(size.x, size.y);
    // Many balls are mere caps: their front is certain, their back is not.
    eye.center_m = {ball.center_m().x, ball.center_m().y, ball.high_m.z - eye.ball_radius_m};
  } else {
    fit_ball(head, eye, eye.rim);
  }
  constexpr float kSocket_m = 0.035f;
  const Enclosed inside = enclosed_by(head, eye.rim, kSocket_m);
  const bool filled = inside.any && inside.depth_m < kShallow_m;
  if (filled) remove_triangles(head, inside.triangle);
  if (filled || !inside.any) {
    add_ring(head, eye.rim, [&](std::size_t i) {
      constexpr float kDeep_m = 0.008f;
      const Vec3 p = head.position_m[eye.rim[i]];
      return p + kDeep_m * glm::normalize(eye.center_m - p) - Vec3(0, 0, 0.25f * kDeep_m);
    });
    set_zone(out, head, Zone::socket);
  } else {
    std::vector<bool> rim(head.position_m.size(), false);
    for (const std::uint32_t v : eye.rim) rim[v] = true;
    for (std::size_t t = 0; t < head.triangles.size(); ++t)
      if (inside.triangle[t])
        for (const std::uint32_t v : head.triangles[t])
          if (!rim[v]) out.zone[v] = Zone::socket;
  }
  head.notes.push_back(std::string(side == 0 ? "left" : "right") +
                       " eye: " + (out.own_ball[s] ? "its own ball turns" : "got a ball") +
                       (filled ? ", opening cut out of the skin" : "") + ", rim of " +
                       std::to_string(eye.rim.size()) + " vertices");
}

// --- Mouth ---

struct LipIds {
  int group, middle, left, right, left_quarter, right_quarter;
};
constexpr LipIds kInnerUpper{2, 2, 4, 5, 6, 7}, kInnerLower{2, 3, 4, 5, 8, 9},
    kOuterUpper{8, 1, 3, 4, 5, 6}, kOuterLower{8, 2, 3, 4, 7, 8};

// A lip's contour from the left corner over the middle to the right one, with its quarter points.
Chain contour(const PointList& points, PlacedHead& head, const LipIds& lip,
              const std::vector<bool>& barred = {}) {
  std::vector<PointId> through{{lip.group, lip.left}};
  if (head.vertex.contains({lip.group, lip.left_quarter}))
    through.push_back({lip.group, lip.left_quarter});
  through.push_back({lip.group, lip.middle});
  if (head.vertex.contains({lip.group, lip.right_quarter}))
    through.push_back({lip.group, lip.right_quarter});
  through.push_back({lip.group, lip.right});
  return way_through(points, head, SurfaceGraph(head.position_m, head.triangles), through, barred);
}

// Gives a contour a vertex between its middle and each corner, and names the quarter points.
void find_quarters(PlacedHead& head, const LipIds& lip, Chain& chain) {
  const auto middle_of = [&] {
    return static_cast<std::size_t>(
        std::find(chain.begin(), chain.end(), head.vertex.at({lip.group, lip.middle})) -
        chain.begin());
  };
  const auto split_after = [&](std::size_t i) {
    const std::uint32_t v = split_edge(head, chain[i], chain[i + 1]);
    chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(i) + 1, v);
  };
  if (middle_of() == 1) split_after(0);
  if (middle_of() + 2 == chain.size()) split_after(middle_of());
  const std::size_t m = middle_of();
  const auto nearest = [&](std::size_t first, std::size_t last, std::uint32_t corner) {
    const float half = 0.5f * (head.position_m[corner].x + head.position_m[chain[m]].x);
    return *std::min_element(
        chain.begin() + static_cast<std::ptrdiff_t>(first),
        chain.begin() + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t a, std::uint32_t b) {
          return std::abs(head.position_m[a].x - half) < std::abs(head.position_m[b].x - half);
        });
  };
  head.vertex.try_emplace({lip.group, lip.left_quarter}, nearest(1, m, chain.front()));
  head.vertex.try_emplace({lip.group, lip.right_quarter},
                          nearest(m + 1, chain.size() - 1, chain.back()));
}

// Half of a contour as 11 columns from the middle to the corner; the quarter point is always one of
// them.
void fill_row(const PlacedHead& head, const Chain& chain, const LipIds& lip, int side, bool upper,
              fat::LipRow& row) {
  const auto at = std::find(chain.begin(), chain.end(), head.vertex.at({lip.group, lip.middle}));
  Chain half = side == 0 ? Chain(chain.begin(), at + 1) : Chain(at, chain.end());
  if (side == 0) std::reverse(half.begin(), half.end());
  const int index = side == 0 ? lip.left_quarter : lip.right_quarter;
  const auto quarter = static_cast<std::size_t>(
      std::find(half.begin(), half.end(), head.vertex.at({lip.group, index})) - half.begin());
  const std::size_t columns = upper ? kLipCorner : kLipColumns - 1 - kLipCorner;
  const std::size_t quarter_column = std::clamp<std::size_t>(
      (2 * quarter * columns + half.size() - 1) / (2 * (half.size() - 1)), 1, columns - 1);
  for (std::size_t c = 0; c <= columns; ++c) {
    std::size_t i = (2 * c * (half.size() - 1) + columns) / (2 * columns);
    if (c == quarter_column && quarter < half.size()) i = quarter;
    row[upper ? c : kLipColumns - 1 - c] = half[i];
  }
}

// Behind the lips of a mask: their inner side, the vestibule, and a bag that ends in the throat.
void add_bag(PlacedHead& head, const Chain& upper, const Chain& lower, Openings& out) {
  const Chain lips = loop_of(upper, lower);
  const Vec3 left = head.position_m[upper.front()], right = head.position_m[upper.back()];
  const float half = std::max(0.5f * (left.x - right.x), 1e-4f);
  const float middle = 0.5f * (left.x + right.x);
  const float deep_z = std::min(left.z, right.z);
  struct Ring {
    float back_m, open_m, narrow, flat;
  };
  constexpr Ring kRings[] = {{0.002f, 0.0008f, 0.99f, 0.0f},
                             {0.006f, 0.006f, 0.96f, 0.1f},
                             {0.018f, 0.014f, 0.85f, 0.6f},
                             {0.040f, 0.012f, 0.60f, 1.0f}};
  Chain ring = lips;
  for (const Ring& r : kRings)
    ring = add_ring(head, ring, [&](std::size_t i) {
      const Vec3 p = head.position_m[lips[i]];
      const float u = std::clamp((p.x - middle) / half, -1.0f, 1.0f);
      const float way = i < upper.size() ? 1.0f : -1.0f;
      return Vec3(middle + r.narrow * (p.x - middle), p.y + way * r.open_m * (1.0f - u * u),
                  glm::mix(p.z, deep_z, r.flat) - r.back_m);
    });
  add_cap(head, ring);
  set_zone(out, head, Zone::mouth);
}

// Height of a contour at some x, linear between its vertices.
float height_at(const PlacedHead& head, const Chain& chain, float x) {
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Vec3 a = head.position_m[chain[i - 1]], b = head.position_m[chain[i]];
    if (x < std::min(a.x, b.x) || x > std::max(a.x, b.x)) continue;
    const float span = b.x - a.x;
    return std::abs(span) < 1e-7f ? a.y : glm::mix(a.y, b.y, (x - a.x) / span);
  }
  return head.position_m[chain.back()].y;
}

// The MPEG-4 neutral face has lips that touch. Many models have them a little apart: both are
// brought to the middle of the gap, and the skin around gives way. Returns the widest gap, m.
float close_lips(PlacedHead& head, const Chain& upper, const Chain& lower) {
  constexpr float kTouching_m = 0.0003f, kReach_m = 0.016f;
  std::map<std::uint32_t, float> lift;
  float gap = 0;
  for (const Chain* chain : {&upper, &lower})
    for (std::size_t i = 1; i + 1 < chain->size(); ++i) {
      const Vec3 p = head.position_m[(*chain)[i]];
      const float top = height_at(head, upper, p.x), bottom = height_at(head, lower, p.x);
      gap = std::max(gap, top - bottom);
      lift[(*chain)[i]] = 0.5f * (top + bottom) - p.y;
    }
  if (gap < kTouching_m) return 0.0f;
  const fat::Skin skin = fat::make_triangle_skin(head.position_m, head.triangles);
  std::vector<std::uint32_t> given;
  std::vector<float> value;
  for (const auto& [v, y] : lift) given.push_back(v), value.push_back(y);
  const auto away = fat::distance_m(skin, given, kReach_m);
  for (std::uint32_t v = 0; v < skin.size(); ++v)
    if (!lift.contains(v) && !(away[v] < kReach_m)) given.push_back(v), value.push_back(0.0f);
  const fat::SmoothFields field(skin, given);
  const std::vector<float> rise = field.solve(value);
  for (std::uint32_t v = 0; v < skin.size(); ++v) head.position_m[v].y += rise[v];
  return gap;
}

void open_mouth(const PointList& points, PlacedHead& head, Openings& out) {
  Chain upper = contour(points, head, kInnerUpper);
  Chain lower;
  const bool sealed = head.vertex.at({2, 2}) == head.vertex.at({2, 3});
  if (sealed) {
    lower = cut_along(upper, head.position_m, head.triangles);
    for (const int index : {3, 8, 9}) {
      const auto at = head.vertex.find({2, index});
      if (at == head.vertex.end()) continue;
      const auto on = std::find(upper.begin(), upper.end(), at->second);
      if (on != upper.end()) at->second = lower[static_cast<std::size_t>(on - upper.begin())];
    }
  } else {
    lower = contour(points, head, kInnerLower, inner_marks(head.position_m.size(), upper));
  }
  find_quarters(head, kInnerUpper, upper);
  find_quarters(head, kInnerLower, lower);
  out.zone.resize(head.position_m.size(), Zone::face);
  constexpr float kMouth_m = 0.09f;
  const Chain loop = loop_of(upper, lower);
  const Enclosed inside = enclosed_by(head, loop, kMouth_m);
  const bool filled = inside.any && inside.depth_m < kShallow_m;
  if (filled) remove_triangles(head, inside.triangle);
  const float gap_m = close_lips(head, upper, lower);
  if (filled || !inside.any) {
    add_bag(head, upper, lower, out);
  } else {
    std::vector<bool> lips(head.position_m.size(), false);
    for (const std::uint32_t v : loop) lips[v] = true;
    for (std::size_t t = 0; t < head.triangles.size(); ++t)
      if (inside.triangle[t])
        for (const std::uint32_t v : head.triangles[t])
          if (!lips[v]) out.zone[v] = Zone::mouth;
  }
  Chain outer_upper = contour(points, head, kOuterUpper);
  Chain outer_lower = contour(points, head, kOuterLower);
  find_quarters(head, kOuterUpper, outer_upper);
  find_quarters(head, kOuterLower, outer_lower);
  out.zone.resize(head.position_m.size(), Zone::face);
  for (int side = 0; side < kSides; ++side) {
    fat::Lips& lips = out.lips[static_cast<std::size_t>(side)];
    lips.row.resize(2);
    fill_row(head, outer_lower, kOuterLower, side, false, lips.row[0]);
    fill_row(head, outer_upper, kOuterUpper, side, true, lips.row[0]);
    fill_row(head, lower, kInnerLower, side, false, lips.row[1]);
    fill_row(head, upper, kInnerUpper, side, true, lips.row[1]);
    lips.upper_outer = lips.lower_outer = 0;
    lips.upper_inner = lips.lower_inner = 1;
  }
  head.notes.push_back(std::string("mouth: ") +
                       (sealed       ? "was shut, cut along the line of the lips"
                        : filled     ? "was filled, cut open"
                        : inside.any ? "its own inside is kept"
                                     : "an opening without an inside") +
                       ", lip line of " + std::to_string(loop.size()) + " vertices");
  if (gap_m > 0) {
    char text[64];
    std::snprintf(text, sizeof text, "neutral face: lips were %.1f mm apart and are shut now",
                  1e3 * double{gap_m});
    head.notes.emplace_back(text);
  }
}

}  // namespace

Openings open_head(const PointList& points, PlacedHead& head) {
  Openings out;
  open_mouth(points, head, out);
  for (int side = 0; side < kSides; ++side) open_eye(points, head, side, out);
  for (int side = 0; side < kSides; ++side) {
    fat::Eye& eye = out.eye[static_cast<std::size_t>(side)];
    const Vec3 lids = eye.center_m;
    eye.inside.assign(head.position_m.size(), false);
    for (std::uint32_t v = 0; v < eye.inside.size(); ++v)
      eye.inside[v] = out.zone[v] == Zone::socket &&
                      std::abs(head.position_m[v].x - lids.x) < 0.5f * head.eye_separation_m;
  }
  return out;
}

}  // namespace caryatid::bake::foreign
