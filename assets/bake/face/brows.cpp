// Brows: frontalis raises them (its middle part the inner ends), corrugator and procerus lower and
// draw them together. The skin slides on the skull; the forehead above gives way up to the hair
// line, the lid below up to its rim. Weights are products of smooth steps along and across the
// brow: unlike a biharmonic field they never swing back, so the forehead cannot fold.
#include <algorithm>
#include <cmath>

#include "assets/bake/face/movement.h"

namespace caryatid::bake::fat {
namespace {

float step(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Smooth hat functions over the three feature points of a brow: each is 1 at its own and 0 at the
// others, and they add up to 1 along the brow. t is 0 at the inner, 1 middle, 2 outer end.
float hat(int which, float t) {
  return step(1.0f - std::abs(std::clamp(t, 0.0f, 2.0f) - static_cast<float>(which)));
}

// Where a skin vertex lies with respect to one brow.
struct Place {
  float along = 0;  // 0 inner end, 1 middle, 2 outer end; beyond them clamped by hat().
  float share = 0;  // How much of the brow's motion it takes, 1 on the brow.
};

std::vector<Place> places(const Head& head, int side) {
  const Vec3 inner = head.place_of(4, 1 + side), middle = head.place_of(4, 3 + side),
             outer = head.place_of(4, 5 + side);
  const float xi = head.lateral(inner, side), xm = head.lateral(middle, side),
              xo = head.lateral(outer, side);
  const Eye& eye = head.eye[static_cast<std::size_t>(side)];
  // The brow's own thickness moves as one; frontalis ends beneath the hair line.
  constexpr float kUnder_m = 0.0065f, kOver_m = 0.008f, kForehead_m = 0.050f, kTemple_m = 0.022f;
  constexpr float kStillRim_m = 0.002f, kLid_m = 0.009f, kNose_m = 0.020f;
  const auto rim_m = distance_m(head.skin, eye.rim, 0.03f);
  std::vector<Place> out(head.skin.size());
  for (std::uint32_t v = 0; v < out.size(); ++v) {
    const Vec3 p = head.skin.position_m[v];
    const float x = head.lateral(p, side);
    if (eye.inside[v] || p.z < eye.center_m.z - 0.025f || head.normal[v].z < -0.2f) continue;
    const float t = x < xm ? (x - xi) / (xm - xi) : 1.0f + (x - xm) / (xo - xm);
    const float line = t < 1.0f ? glm::mix(inner.y, middle.y, std::max(t, 0.0f))
                                : glm::mix(middle.y, outer.y, std::min(t, 2.0f) - 1.0f);
    const float above = p.y - line;
    // Both brows share the skin between them; behind the other one's end nothing moves.
    float share = step(0.5f + 0.5f * x / (xi - 0.001f)) * step(1.0f - (x - xo) / kTemple_m);
    if (above > kOver_m) share *= step(1.0f - (above - kOver_m) / (kForehead_m - kOver_m));
    if (above < -kUnder_m) {
      share *= step(1.0f - (-above - kUnder_m) / kNose_m);
      if (std::isfinite(rim_m[v])) share *= step((rim_m[v] - kStillRim_m) / kLid_m);
    }
    out[v] = {t, share};
  }
  // The feature points are exact.
  for (int i = 0; i < 3; ++i)
    out[head.vertex_of(4, 1 + 2 * i + side)] = {static_cast<float>(i), 1.0f};
  return out;
}

}  // namespace

void add_brows(const Head& head, const ReachOf& reach, std::vector<Movement>& out) {
  for (int side = 0; side < kSides; ++side) {
    const std::vector<Place> place = places(head, side);
    const auto field = [&](const std::function<Vec3(const Place&, Vec3 normal)>& at, float m) {
      std::vector<Vec3> moved(place.size(), Vec3(0));
      for (std::size_t v = 0; v < moved.size(); ++v)
        if (place[v].share > 0.0f) moved[v] = m * place[v].share * at(place[v], head.normal[v]);
      return moved;
    };
    for (int which = 0; which < 3; ++which) {
      const int fap = 31 + 2 * which + side;
      add_movements(
          head, fap, reach(fap), 1,
          [&](float m) {
            return field(
                [&](const Place& at, Vec3 normal) {
                  // Raised skin lies flat on the bone; lowered skin bunches over the
                  // ridge of the orbit and hangs before the lid.
                  const Vec3 bulge = m < 0 ? 0.35f * normal * Vec3(1, 0, 1) : Vec3(0);
                  return hat(which, at.along) * (along_surface(normal, {0, 1, 0}) - bulge);
                },
                m);
          },
          out);
    }
    // Corrugator: the inner end goes farthest, skin piles up between the brows.
    const Vec3 medial{-outward(side), 0, 0};
    add_movements(
        head, 37 + side, reach(37 + side), 1,
        [&](float m) {
          return field(
              [&](const Place& at, Vec3 normal) {
                const float share = at.along < 1.0f ? 1.0f - 0.45f * std::max(at.along, 0.0f)
                                                    : 0.55f * hat(1, at.along);
                return share * (along_surface(normal, medial) + Vec3(0, 0, 0.15f));
              },
              m);
        },
        out);
  }
}

}  // namespace caryatid::bake::fat
