// Brows: frontalis raises them (its middle part the inner ends), corrugator and procerus lower and
// draw them together. The skin slides on the skull; forehead and upper lid give way.
#include <algorithm>
#include <cmath>

#include "assets/bake/face/movement.h"
#include "assets/bake/face/smooth.h"

namespace caryatid::bake::fat {
namespace {

// Smooth hat functions over the three feature points of a brow: each is 1 at its own and 0 at the
// others, and they add up to 1 along the brow. t is 0 at the inner, 1 middle, 2 outer end.
float hat(int which, float t) {
  const float d = std::min(std::abs(std::clamp(t, 0.0f, 2.0f) - static_cast<float>(which)), 1.0f);
  return 1.0f - d * d * (3.0f - 2.0f * d);
}

struct Handles {
  std::vector<std::uint32_t> vertex;
  std::vector<float> t;  // Along the own brow; -1: belongs to the other brow or must stay.
};

// The band of skin under the brow's hairs.
void add_brow_band(const Head& head, int side, float mark, Handles& handles) {
  const Vec3 inner = head.place_of(4, 1 + side), middle = head.place_of(4, 3 + side),
             outer = head.place_of(4, 5 + side);
  for (std::uint32_t v = 0; v < head.skin.size(); ++v) {
    const Vec3 p = head.skin.position_m[v];
    const float x = head.lateral(p, side);
    const float xi = head.lateral(inner, side), xm = head.lateral(middle, side),
                xo = head.lateral(outer, side);
    if (x < xi - 0.002f || x > xo + 0.002f || p.z < outer.z - 0.015f) continue;
    const float t = x < xm ? (x - xi) / (xm - xi) : 1.0f + (x - xm) / (xo - xm);
    const float y = t < 1 ? glm::mix(inner.y, middle.y, t) : glm::mix(middle.y, outer.y, t - 1);
    if (p.y - y < -0.0045f || p.y - y > 0.007f) continue;
    handles.vertex.push_back(v);
    handles.t.push_back(mark < 0 ? mark : t);
  }
  // The points themselves are exact.
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t v = head.vertex_of(4, 1 + 2 * i + side);
    const auto found = std::find(handles.vertex.begin(), handles.vertex.end(), v);
    if (found == handles.vertex.end()) handles.vertex.push_back(v), handles.t.push_back(0);
    const auto at = static_cast<std::size_t>(
        (found == handles.vertex.end() ? handles.vertex.size() - 1
                                       : static_cast<std::size_t>(found - handles.vertex.begin())));
    handles.t[at] = mark < 0 ? mark : static_cast<float>(i);
  }
}

// What a brow does not take along: lids near the rim, nose, the back of the head, cheeks.
void add_still(const Head& head, int side, Handles& handles) {
  std::vector<bool> taken(head.skin.size(), false);
  for (const std::uint32_t v : handles.vertex) taken[v] = true;
  const Eye& eye = head.eye[static_cast<std::size_t>(side)];
  const auto rim_m = distance_m(head.skin, eye.rim, 0.02f);
  const float brow = head.place_of(4, 3 + side).y;
  const float top = brow + 0.055f;  // Frontalis ends above the hair line; the skin has slack there.
  const float lowest = head.place_of(3, 7 + 5 * side).y + 0.002f;
  const float outer = head.lateral(head.place_of(4, 5 + side), side) + 0.022f;
  for (std::uint32_t v = 0; v < head.skin.size(); ++v) {
    const Vec3 p = head.skin.position_m[v];
    const float x = head.lateral(p, side);
    const bool free = !eye.inside[v] && rim_m[v] > 0.0025f && p.y < top && p.y > lowest &&
                      x < outer && x > -0.022f && p.z > eye.center_m.z - 0.022f;
    if (free || taken[v]) continue;
    handles.vertex.push_back(v);
    handles.t.push_back(-1.0f);
  }
}

}  // namespace

void add_brows(const Head& head, const ReachOf& reach, std::vector<Movement>& out) {
  for (int side = 0; side < kSides; ++side) {
    Handles handles;
    add_brow_band(head, side, 0.0f, handles);
    add_brow_band(head, 1 - side, -1.0f, handles);
    add_still(head, side, handles);
    const SmoothFields fields(head.skin, handles.vertex);
    const auto solve = [&](const std::function<Vec3(float t, std::uint32_t v)>& at) {
      std::vector<Vec3> value(handles.vertex.size(), Vec3(0));
      for (std::size_t i = 0; i < value.size(); ++i)
        if (handles.t[i] >= 0.0f) value[i] = at(handles.t[i], handles.vertex[i]);
      return fields.solve(value);
    };
    const auto scaled = [](std::vector<Vec3> field, float by) {
      for (Vec3& d : field) d *= by;
      return field;
    };
    for (int which = 0; which < 3; ++which) {
      // Raised skin lies flat on the bone; lowered skin bunches over the ridge of the orbit.
      const auto up = solve([&](float t, std::uint32_t v) {
        return hat(which, t) * along_surface(head.normal[v], {0, 1, 0});
      });
      const auto down = solve([&](float t, std::uint32_t v) {
        return hat(which, t) *
               (along_surface(head.normal[v], {0, 1, 0}) - 0.25f * head.normal[v] * Vec3(1, 0, 1));
      });
      const int fap = 31 + 2 * which + side;
      add_movements(
          head, fap, reach(fap), 1, [&](float m) { return scaled(m < 0 ? down : up, m); }, out);
    }
    // Corrugator: the inner end goes farthest, skin piles up between the brows.
    const Vec3 medial{-outward(side), 0, 0};
    const auto squeeze = solve([&](float t, std::uint32_t v) {
      const float share = t < 1 ? 1.0f - 0.45f * t : 0.55f * hat(0, t - 1.0f);
      return share * (along_surface(head.normal[v], medial) + Vec3(0, 0, 0.15f));
    });
    add_movements(
        head, 37 + side, reach(37 + side), 1, [&](float m) { return scaled(squeeze, m); }, out);
  }
}

}  // namespace caryatid::bake::fat
