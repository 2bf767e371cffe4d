// Jaw (masseter and temporalis shut, digastric and pterygoids open, thrust and shift): the skin
// over the mandible turns with it about the axis through both temporomandibular joints; lips stay,
// as the standard says of FAP 3. The lower lip swings back with the jaw when its own FAPs lower it.
#include <algorithm>
#include <cmath>

#include "assets/bake/face/movement.h"

namespace caryatid::bake::fat {
namespace {

// Share of the mandible's motion at every skin vertex: the rig's, less what belongs to the lips.
// `spared` 1: the lips stay; 0: the lower one goes along.
std::vector<float> jaw_weight(const Head& head, float spared) {
  const float scale = 1.0f / std::max(head.mandible[head.vertex_of(2, 1)], 0.5f);
  const std::vector<float> lips = lip_share(head);
  std::vector<float> weight(head.skin.size());
  for (std::uint32_t v = 0; v < weight.size(); ++v)
    weight[v] = std::clamp(head.mandible[v] * scale, 0.0f, 1.0f) * (1.0f - spared * lips[v]);
  weight[head.vertex_of(2, 1)] = 1.0f;
  return weight;
}

Vec3 turned(Vec3 p, Vec3 center, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  const float y = p.y - center.y, z = p.z - center.z;
  return {p.x, center.y + c * y - s * z, center.z + s * y + c * z};
}

}  // namespace

void add_jaw(const Head& head, const ReachOf& reach, std::vector<Movement>& out) {
  const std::vector<float> weight = jaw_weight(head, 1.0f);
  const Vec3 center = head.transforms.jaw_center_m;
  const auto drop = [&](float m) {
    const float angle = face::jaw_angle_rad(head.transforms, m);
    std::vector<Vec3> field(head.skin.size(), Vec3(0));
    for (std::uint32_t v = 0; v < field.size(); ++v) {
      // Half-way skin is carried by a smaller turn, not along the chord: cheeks do not cave in.
      const Vec3 p = head.skin.position_m[v];
      if (weight[v] > 0.0f) field[v] = turned(p, center, angle * weight[v]) - p;
    }
    return field;
  };
  add_movements(head, 3, reach(3), 3, drop, out);
  // Lower teeth that come forward push the lower lip before them; sideways they slide along it.
  const std::vector<float> with_lip = jaw_weight(head, 0.15f), half_lip = jaw_weight(head, 0.5f);
  const auto shift = [](const std::vector<float>& by, Vec3 axis) {
    return [&by, axis](float m) {
      std::vector<Vec3> field;
      for (const float w : by) field.push_back(w * m * axis);
      return field;
    };
  };
  add_movements(head, 14, reach(14), 1, shift(with_lip, {0, 0, 1}), out);
  add_movements(head, 15, reach(15), 1, shift(half_lip, {-1, 0, 0}), out);

  // Corrections: a lower lip that its own FAPs lower swings back with an open jaw.
  const Vec3 arm = head.place_of(2, 3) - center;
  const float back = -arm.y / arm.z;  // Part along -z for one unit downwards.
  std::vector<Movement> swings;
  for (const Movement& m : out) {
    const bool lower =
        m.fap == 5 || m.fap == 10 || m.fap == 11 || m.fap == 52 || m.fap == 57 || m.fap == 58;
    if (!lower || m.reach > 0 || m.partner != 0) continue;
    Movement swing{.fap = m.fap, .reach = m.reach, .frames = {}, .partner = 3, .partner_to = 300};
    std::vector<Vec3> field = m.frames.back();
    for (Vec3& d : field) d = {0, 0, back * d.y};
    swing.frames.push_back(std::move(field));
    swings.push_back(std::move(swing));
  }
  for (Movement& s : swings) out.push_back(std::move(s));
}

}  // namespace caryatid::bake::fat
