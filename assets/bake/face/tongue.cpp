#include "assets/bake/face/tongue.h"

#include <algorithm>
#include <cmath>

namespace caryatid::bake::fat {
namespace {

// Where a vertex lies on the tongue: along from root (0) to tip (1), across from -1 to 1.
struct Place {
  float along = 0, across = 0;
};

struct Tongue {
  const Mesh& mesh;
  Vec3 low{1e9f}, high{-1e9f};
  Vec3 tip{0}, body{0};

  Place at(Vec3 p) const {
    return {(p.z - low.z) / (high.z - low.z), 2.0f * (p.x - low.x) / (high.x - low.x) - 1.0f};
  }
};

float smooth(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// Only the front half follows the tip, the more the nearer to it.
float tip_share(const Tongue& tongue, Vec3 p) {
  const float from = 0.35f, at = tongue.at(p).along, tip = tongue.at(tongue.tip).along;
  return smooth((at - from) / (tip - from));
}

float body_share(const Tongue& tongue, Vec3 p) {
  const float d = (tongue.at(p).along - tongue.at(tongue.body).along) / 0.45f;
  return std::abs(d) < 1.0f ? (1.0f - d * d) * (1.0f - d * d) : 0.0f;
}

// A tip that comes out gets thin and pointed, or it would not pass between teeth and lips.
Vec3 thrust(const Tongue& tongue, Vec3 p, float m) {
  constexpr float kFull_m = 0.006f, kThinnest = 0.4f, kNarrowest = 0.85f, kHalfTip_m = 0.010f;
  const float share = tip_share(tongue, p);
  const float formed = share * smooth(m / kFull_m);
  const float middle = 0.5f * (tongue.low.x + tongue.high.x), x = p.x - middle;
  // The tip itself leads, its edges stay behind by up to a third of the way.
  const float aside = std::abs(x) - std::abs(tongue.tip.x - middle);
  const float t = std::clamp(aside / kHalfTip_m, 0.0f, 1.0f);
  const float lag = m > 0.0f ? 0.3f * t * t : 0.0f;
  return {-(1.0f - kNarrowest) * formed * x, -(1.0f - kThinnest) * formed * (p.y - tongue.tip.y),
          m * share * (1.0f - lag)};
}

// In an open mouth the tip comes out over the lower lip, which stands higher than the teeth that
// the tongue rests behind: how far up at each of the steps of a thrust, for a jaw open by kOpenJaw.
constexpr float kOpenJaw = 520.0f, kOverLip_m = 0.0095f, kOverLipAt_m = 0.0105f;
constexpr int kThrustSteps = 4;

Vec3 over_lip(const Tongue& tongue, Vec3 p, float from_m, float to_m) {
  const float lift = smooth(to_m / kOverLipAt_m) - smooth(from_m / kOverLipAt_m);
  return {0, kOverLip_m * lift * tip_share(tongue, p), 0};
}

// Edges rise about the mid-line like the leaves of a book.
Vec3 rolled(const Tongue& tongue, Vec3 p, float angle) {
  const float middle = 0.5f * (tongue.low.x + tongue.high.x);
  const float bend = angle * smooth(std::abs(tongue.at(p).across)) * smooth(tongue.at(p).along * 2);
  const float x = p.x - middle;
  return {x * (std::cos(bend) - 1.0f), std::abs(x) * std::sin(bend), 0};
}

std::vector<Move> moves_of(const Tongue& tongue, const std::function<Vec3(Vec3)>& displace) {
  std::vector<Move> out;
  for (std::uint32_t i = 0; i < tongue.mesh.position_m.size(); ++i)
    if (const Vec3 d = displace(tongue.mesh.position_m[i]); glm::length(d) > 5e-6f)
      out.push_back({i, d, Vec3(0)});
  return out;
}

}  // namespace

std::vector<PartMove> tongue_moves(const Character& character, const Head& head,
                                   const ReachOf& reach) {
  std::vector<PartMove> out;
  for (std::uint32_t o = 0; o < character.objects.size(); ++o) {
    if (character.objects[o].name != "tongue") continue;
    Tongue tongue{.mesh = character.objects[o].mesh};
    for (const Vec3& p : tongue.mesh.position_m) {
      tongue.low = glm::min(tongue.low, p);
      tongue.high = glm::max(tongue.high, p);
    }
    tongue.tip = head.place_of(6, 1);
    tongue.body = head.place_of(6, 2);
    const auto add = [&](int fap, const std::function<Vec3(Vec3 p, float m)>& displace) {
      for (const float end : {reach(fap).low, reach(fap).high}) {
        if (end == 0.0f) continue;
        PartMove move{o, {static_cast<std::uint16_t>(fap), 0, 0.0f, end, 0.0f, 0.0f}, {}};
        if (fap == 3) move.channel.to = 400.0f;  // Flat by then; the jaw goes on.
        const float amount = end * metres_per_unit(head, fap);
        move.moves = moves_of(tongue, [&](Vec3 p) { return displace(p, amount); });
        out.push_back(std::move(move));
      }
    };
    add(43, [&](Vec3 p, float m) { return Vec3(-m * tip_share(tongue, p), 0, 0); });
    add(44, [&](Vec3 p, float m) { return Vec3(0, m * tip_share(tongue, p), 0); });
    add(45, [&](Vec3 p, float m) { return thrust(tongue, p, m); });
    for (int k = 0; k < kThrustSteps; ++k) {
      const float end = reach(45).high, unit_m = metres_per_unit(head, 45);
      const float from = end * static_cast<float>(k) / kThrustSteps;
      const float to = end * static_cast<float>(k + 1) / kThrustSteps;
      out.push_back({o, {45, 3, from, to, 0.0f, kOpenJaw}, moves_of(tongue, [&](Vec3 p) {
                       return over_lip(tongue, p, from * unit_m, to * unit_m);
                     })});
    }
    add(46, [&](Vec3 p, float m) { return Vec3(0, m * body_share(tongue, p), 0); });
    // The jaw takes it along, and its back lowers besides: the tip stays behind the lower teeth.
    const float open_m = 400.0f * metres_per_unit(head, 3);
    add(3, [&](Vec3 p, float drop_m) {
      constexpr float kFlatter = 0.5f;
      const float share = kFlatter * std::min(drop_m / open_m, 1.0f);
      return Vec3(0, -share * std::max(p.y - tongue.tip.y, 0.0f), 0);
    });
    add(47, [&](Vec3 p, float angle) { return rolled(tongue, p, angle); });
  }
  return out;
}

}  // namespace caryatid::bake::fat
