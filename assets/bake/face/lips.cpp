// Lips (orbicularis oris shuts and pushes; levator labii and zygomaticus raise, depressor labii and
// depressor anguli lower, risorius and buccinator stretch, mentalis pushes the lower lip up). Inner
// and outer contour move apart, each by its own FAPs; the red between and the skin around follow
// smoothly. What moves sideways follows the arch of the teeth.
#include <algorithm>
#include <cmath>

#include "assets/bake/face/movement.h"
#include "assets/bake/face/smooth.h"

namespace caryatid::bake::fat {
namespace {

// A vertex of a contour: u runs along it, 0 mid-line, 1 corner, with the quarter point at 0.5.
struct Handle {
  std::uint32_t vertex = 0;
  int side = 0;
  bool upper = false, inner = false;
  float u = 0;
};

// Cardinal functions of the knots -1, -0.5, 0, 0.5, 1: half a natural look (cubic), half without
// overshoot (smooth hats), so that a single point neither kinks nor bends its neighbours back.
float cardinal(float knot, float u) {
  const float d = std::abs(u - knot) / 0.5f;
  if (d >= 2.0f) return 0.0f;
  const float hat = d < 1.0f ? 1.0f - d * d * (3.0f - 2.0f * d) : 0.0f;
  const float cubic =
      d < 1.0f ? 1.0f - d * d * (2.5f - 1.5f * d) : -0.5f * (d - 1.0f) * (2.0f - d) * (2.0f - d);
  return 0.6f * hat + 0.4f * cubic;
}

class Mouth {
 public:
  explicit Mouth(const Head& head) : head_(head) {
    add_contours();
    add_still();
    std::vector<std::uint32_t> given;
    for (const Handle& h : handles_) given.push_back(h.vertex);
    for (const std::uint32_t v : still_) given.push_back(v);
    fields_ = std::make_unique<SmoothFields>(head.skin, given);
  }

  std::vector<Vec3> solve(const std::function<Vec3(const Handle&)>& at) const {
    std::vector<Vec3> value(handles_.size() + still_.size(), Vec3(0));
    for (std::size_t i = 0; i < handles_.size(); ++i) value[i] = at(handles_[i]);
    return fields_->solve(value);
  }

  // Shift in depth of a point of the lips that moves sideways by dx: along the dental arch.
  float along_arch(const Handle& h, float dx) const {
    const Vec3 p = head_.skin.position_m[h.vertex];
    const float x = std::abs(head_.lateral(p, 0)), moved = std::abs(head_.lateral(p, 0) + dx);
    return arch(moved) - arch(x);
  }

 private:
  // Parabola through the middle and the corner of the mouth, straight beyond the corner.
  float arch(float x) const {
    const Vec3 middle = head_.place_of(2, 2), corner = head_.place_of(2, 4);
    const float half = std::abs(corner.x - middle.x);
    const float depth = std::min(middle.z - corner.z, 0.6f * half);
    return x < half ? -depth * x * x / (half * half) : -depth - 1.2f * depth / half * (x - half);
  }

  void add_contour(int side, bool upper, bool inner) {
    const Lips& lips = head_.lips[static_cast<std::size_t>(side)];
    const std::size_t r = inner ? (upper ? lips.upper_inner : lips.lower_inner)
                                : (upper ? lips.upper_outer : lips.lower_outer);
    const std::size_t first = upper ? 0 : kLipCorner + 1;
    const std::size_t last = upper ? kLipCorner : kLipColumns - 1;
    const LipRow& row = lips.row[r];
    const auto x = [&](std::uint32_t v) { return head_.lateral(head_.skin.position_m[v], side); };
    const float corner = x(row[kLipCorner]);
    // Left: 2.4 and 8.3 the corners, 2.6, 2.8, 8.5, 8.7 the quarter points; right one further.
    const int group = inner ? 2 : 8;
    const int quarter = (inner ? (upper ? 6 : 8) : (upper ? 5 : 7)) + side;
    const float xq = x(head_.vertex_of(group, quarter));
    for (std::size_t c = first; c <= last; ++c) {
      const float at = std::clamp(x(row[c]), 0.0f, corner);
      float u = at < xq ? 0.5f * at / xq : 0.5f + 0.5f * (at - xq) / std::max(corner - xq, 1e-6f);
      if (c == kLipCorner) u = 1.0f;
      if (row[c] == head_.vertex_of(group, quarter)) u = 0.5f;
      add({row[c], side, upper, inner, u});
    }
  }

  void add(const Handle& handle) {
    for (const Handle& h : handles_)
      if (h.vertex == handle.vertex) return;  // Corners and the mid-line belong to two contours.
    handles_.push_back(handle);
  }

  void add_contours() {
    for (int side = 0; side < kSides; ++side) {
      const int corner = side;
      // Corners first: they belong to both lips, and must be exact.
      add({head_.vertex_of(2, 4 + corner), side, true, true, 1.0f});
      add({head_.vertex_of(8, 3 + corner), side, true, false, 1.0f});
      for (const bool upper : {true, false})
        for (const bool inner : {true, false}) add_contour(side, upper, inner);
    }
    for (int side = 0; side < kSides; ++side) add_lining(side);
  }

  // Behind the corners the lining of the cheek is a tight fold: it goes with the inner contour.
  void add_lining(int side) {
    const Lips& lips = head_.lips[static_cast<std::size_t>(side)];
    for (std::size_t c = kLipCorner - 3; c <= kLipCorner + 3; ++c) {
      const std::size_t inner = c <= kLipCorner ? lips.upper_inner : lips.lower_inner;
      const std::uint32_t front = lips.row[inner][c];
      const auto found = std::find_if(handles_.begin(), handles_.end(),
                                      [&](const Handle& h) { return h.vertex == front; });
      if (found == handles_.end()) continue;
      Handle handle = *found;
      for (std::size_t r = inner + 1; r < lips.row.size(); ++r) {
        handle.vertex = lips.row[r][c];
        add(handle);
      }
    }
  }

  // The upper jaw's gums, the nose, and all that is far from the mouth.
  void add_still() {
    std::vector<std::uint32_t> outer;
    std::vector<bool> taken(head_.skin.size(), false);
    for (const Handle& h : handles_) {
      taken[h.vertex] = true;
      if (!h.inner) outer.push_back(h.vertex);
    }
    // Inside the mouth everything beyond the vestibule's last ring stays.
    std::vector<bool> grid(head_.skin.size(), false);
    for (const Lips& lips : head_.lips)
      for (const LipRow& row : lips.row)
        for (const std::uint32_t v : row) grid[v] = true;
    const auto away = distance_m(head_.skin, outer, 0.05f);
    const float nose = head_.place_of(9, 15).y - 0.001f;
    const float chin = head_.place_of(2, 10).y;
    const float wing = head_.lateral(head_.place_of(9, 1), 0);
    const Vec3 corner = head_.place_of(2, 4);
    constexpr float kReach_m = 0.034f;
    for (std::uint32_t v = 0; v < head_.skin.size(); ++v) {
      if (taken[v]) continue;
      const Vec3 p = head_.skin.position_m[v];
      const bool beneath_nose = p.y > nose && std::abs(head_.lateral(p, 0)) < wing + 0.003f;
      const bool inside = head_.normal[v].z < 0.2f && !grid[v] && p.z < corner.z - 0.002f &&
                          std::abs(head_.lateral(p, 0)) < head_.lateral(corner, 0) - 0.005f;
      bool deep = false;  // Gums in front; at the sides the lining goes with the cheek.
      for (const Lips& lips : head_.lips)
        for (std::size_t c = 0; c < kLipColumns; ++c)
          deep |= (c < 6 || c > 14) && lips.row.back()[c] == v;
      const bool free = away[v] < kReach_m && !beneath_nose && !inside && !deep && p.y > chin;
      if (!free) still_.push_back(v);
    }
  }

  const Head& head_;
  std::vector<Handle> handles_;
  std::vector<std::uint32_t> still_;
  std::unique_ptr<SmoothFields> fields_;
};

// Signed place along the whole lip: left positive.
float place(const Handle& h) { return h.u * outward(h.side); }

// Vertical FAPs of one point of a contour; `raising_m` upwards.
std::vector<Vec3> lift(const Mouth& mouth, bool upper, bool inner, float knot, float raising_m) {
  // A raised upper lip curls forward a little; a lowered lower lip rolls out over the gum.
  const float forward = upper ? 0.08f : 0.03f;
  return mouth.solve([&](const Handle& h) {
    if (h.upper != upper || h.inner != inner || (h.u == 1.0f && std::abs(knot) < 1.0f))
      return Vec3(0);
    const float w = cardinal(knot, place(h));
    return w * Vec3(0, raising_m, forward * std::abs(raising_m));
  });
}

std::vector<Vec3> move_corner(const Mouth& mouth, bool inner, int side, Vec3 by) {
  return mouth.solve([&](const Handle& h) {
    if (h.inner != inner || h.side != side) return Vec3(0);
    // Sideways the whole half of the lip stretches; only its corner has a FAP for that. Up and down
    // the quarter point has its own.
    const float across = h.u, up = h.u >= 1.0f ? 1.0f : cardinal(1.0f, h.u);
    return Vec3(across * by.x, up * by.y, up * by.z + mouth.along_arch(h, across * by.x));
  });
}

// Lip pushed forward as a whole; the outer contour follows, the corners stay.
std::vector<Vec3> push(const Mouth& mouth, bool upper, float forward_m) {
  return mouth.solve([&](const Handle& h) {
    if (h.upper != upper || h.u == 1.0f) return Vec3(0);
    const float w = (1.0f - h.u * h.u) * (1.0f - h.u * h.u);
    return Vec3(0, 0, w * forward_m * (h.inner ? 1.0f : 0.55f));
  });
}

void add_vertical(const Head& head, const Mouth& mouth, const ReachOf& reach,
                  std::vector<Movement>& out) {
  struct Point {
    int fap;
    bool upper, inner;
    float knot;
  };
  constexpr Point kPoints[] = {
      {4, true, true, 0},    {8, true, true, 0.5f},    {9, true, true, -0.5f},
      {5, false, true, 0},   {10, false, true, 0.5f},  {11, false, true, -0.5f},
      {51, true, false, 0},  {55, true, false, 0.5f},  {56, true, false, -0.5f},
      {52, false, false, 0}, {57, false, false, 0.5f}, {58, false, false, -0.5f}};
  for (const Point& p : kPoints)
    add_movements(
        head, p.fap, reach(p.fap), 1,
        [&](float m) {
          // Upper lip FAPs are positive downwards.
          return lift(mouth, p.upper, p.inner, p.knot, p.upper ? -m : m);
        },
        out);
}

}  // namespace

std::vector<float> lip_share(const Head& head) {
  std::vector<float> share;
  for (const Vec3& v : Mouth(head).solve([](const Handle&) { return Vec3(1, 0, 0); }))
    share.push_back(std::clamp(v.x, 0.0f, 1.0f));
  return share;
}

void add_lips(const Head& head, const ReachOf& reach, std::vector<Movement>& out) {
  const Mouth mouth(head);
  add_vertical(head, mouth, reach, out);
  for (int side = 0; side < kSides; ++side)
    for (const bool inner : {true, false}) {
      const int stretch = (inner ? 6 : 53) + side, raise = (inner ? 12 : 59) + side;
      add_movements(
          head, stretch, reach(stretch), 2,
          [&](float m) {
            return move_corner(mouth, inner, side, {outward(side) * m, 0, 0});
          },
          out);
      add_movements(
          head, raise, reach(raise), 1,
          [&](float m) {
            // Corners are pulled up and back (zygomaticus), or down.
            return move_corner(mouth, inner, side, {0, m, m > 0 ? -0.15f * m : 0.0f});
          },
          out);
    }
  add_movements(
      head, 16, reach(16), 1, [&](float m) { return push(mouth, false, m); }, out);
  add_movements(
      head, 17, reach(17), 1, [&](float m) { return push(mouth, true, m); }, out);
}

}  // namespace caryatid::bake::fat
