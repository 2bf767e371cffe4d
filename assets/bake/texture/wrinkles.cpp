#include "assets/bake/texture/wrinkles.h"

#include <array>
#include <span>
#include <stdexcept>

namespace caryatid::bake {
namespace {

constexpr float kLevel = 8.0f / 15.0f;

// The cut through a fold at signed distance d from its furrow, in its width: a narrow furrow in a
// shallow valley, and the ridge on the side of positive d, which faces the light.
float fold(float d, float lit) {
  const auto bell = [](float x) { return std::exp(-x * x); };
  return -0.75f * bell(d) - 0.22f * bell(d / 3.0f) + lit * 0.34f * bell((d - 2.2f) / 1.2f) +
         0.14f * bell((std::abs(d) - 3.2f) / 1.6f);
}

// 1 between begin and end, fading in and out over `soft`.
float span_of(float x, float begin, float end, float soft) {
  return smooth_step(begin - soft, begin + soft, x) * smooth_step(end + soft, end - soft, x);
}

class Face {
 public:
  explicit Face(const Character& c) {
    const auto at = [&c](int group, int index) {
      for (const FeaturePoint& f : c.feature_points)
        if (f.group == group && f.index == index) return f.position_m;
      throw std::runtime_error(c.name + ": lines can't be drawn without the feature points");
    };
    inner_brow_ = at(4, 1), middle_brow_ = at(4, 3), outer_brow_ = at(4, 5);
    hairline_ = at(11, 1);
    eye_ = at(3, 5), canthus_ = at(3, 7), lower_lid_ = at(3, 9);
    wing_ = at(9, 1), corner_ = at(8, 3);
    chin_ = at(2, 1);
  }

  // Rows over the brows, their middles a little lower than their sides, none alike and none whole.
  float forehead(Vec3 p) const {
    const float low_m = middle_brow_.y + 0.011f, high_m = hairline_.y - 0.004f;
    constexpr int kRows = 5;
    const float x = std::abs(p.x) / outer_brow_.x;
    float sum = 0.0f;
    for (int i = 0; i < kRows; ++i) {
      const float along = static_cast<float>(i) / (kRows - 1);
      const float wave = noise(Vec3{p.x * 55.0f, 7.7f * along, 1.0f + 13.0f * along});
      const float y = glm::mix(low_m, high_m, 0.88f * along) +
                      0.0040f * (x * x) * (1.0f - 2.2f * x * x * x) + 0.0013f * wave;
      const float broken = smooth_step(
          -0.75f, -0.1f, noise(Vec3{p.x * 70.0f, 3.1f + 5.0f * along, 2.0f + 17.0f * along}));
      const float reach = 0.95f - 0.22f * along + 0.08f * lattice(i, 3, 5);
      const float strength =
          glm::mix(1.0f, 0.45f, along) * broken * span_of(x, -1.0f, reach, 0.16f);
      sum += strength * fold((y - p.y) / 0.00105f, 1.0f);
    }
    return p.y > low_m - 0.012f ? sum : 0.0f;
  }

  // Two upright lines that lean apart above, and the crease across the root of the nose.
  float glabella(Vec3 p) const {
    const float base_m = inner_brow_.y;
    const float up = p.y - base_m;
    const float wave = 0.0007f * noise(Vec3{p.y * 160.0f, 9.0f, p.x > 0 ? 4.0f : 8.0f});
    const float lean = 0.55f * inner_brow_.x + 0.10f * up + wave;
    const float lines =
        fold((std::abs(p.x) - lean) / 0.00115f, 0.6f) * span_of(up, -0.005f, 0.013f, 0.006f);
    const float short_line = 0.5f * fold((std::abs(p.x) - 1.75f * lean) / 0.0010f, 0.5f) *
                             span_of(up, 0.003f, 0.011f, 0.005f);
    const float root_m = 0.5f * (base_m + eye_.y) - 0.001f + 7.0f * p.x * p.x;
    const float across = 0.75f * fold((root_m - p.y) / 0.0012f, 0.8f) *
                         span_of(std::abs(p.x), -1.0f, 0.0075f, 0.003f);
    const float low = 0.45f * fold((root_m - 0.0055f - p.y) / 0.0011f, 0.8f) *
                      span_of(std::abs(p.x), -1.0f, 0.0065f, 0.003f);
    return lines + short_line + across + low;
  }

  // A fan from beyond the outer corner, and the bag that the cheek pushes up under the lower lid.
  float crows_foot(Vec3 p) const {
    p.x = std::abs(p.x);
    const Vec3 d = p - canthus_;
    const float out = std::sqrt(d.x * d.x + d.z * d.z) * (d.x > 0 || d.z < -0.004f ? 1.0f : -1.0f);
    const float rho = std::sqrt(out * out + d.y * d.y);
    const float angle = std::atan2(d.y, out);
    struct Ray {
      float angle, bend, begin_m, end_m, strength;
    };
    constexpr Ray kRays[] = {{0.50f, 10.0f, 0.009f, 0.016f, 0.4f},
                             {0.24f, 5.0f, 0.007f, 0.024f, 1.0f},
                             {-0.12f, -5.0f, 0.008f, 0.026f, 0.9f},
                             {-0.50f, -12.0f, 0.009f, 0.023f, 0.8f},
                             {-0.86f, -16.0f, 0.011f, 0.019f, 0.5f}};
    float sum = 0.0f;
    if (out > 0.0f)
      for (const Ray& r : kRays) {
        const float off = rho * (r.angle + r.bend * (rho - 0.008f) - angle);
        sum += r.strength * fold(off / 0.0012f, 0.9f) * span_of(rho, r.begin_m, r.end_m, 0.0035f);
      }
    // The bag: an arc below the lid's rim, deepest under the inner half.
    const Vec3 e = p - eye_;
    const float half_m = canthus_.x - eye_.x, x = e.x / half_m;
    const float drop_m = eye_.y - lower_lid_.y + 0.0062f;
    const float arc_m = -drop_m * std::sqrt(std::max(1.0f - 0.42f * x * x, 0.05f));
    const float bag = 0.55f * fold((arc_m - e.y) / 0.0019f, 0.9f) * span_of(x, -0.80f, 0.85f, 0.3f);
    return sum + (e.z > -0.01f ? bag : 0.0f);
  }

  // From above the wing of the nose in an arc past the corner of the mouth; the cheek is the ridge.
  float nasolabial(Vec3 p) const {
    p.x = std::abs(p.x);
    const Vec2 a = Vec2{wing_} + Vec2{0.0010f, 0.0050f};
    const Vec2 c = Vec2{corner_} + Vec2{0.0100f, -0.0075f};
    const Vec2 b = glm::mix(a, c, 0.5f) + Vec2{0.0075f, 0.0050f};
    float best_m = 1.0f, side = 1.0f, share = 0.0f;
    constexpr int kSteps = 24;
    Vec2 last = a;
    for (int i = 1; i <= kSteps; ++i) {
      const float t = static_cast<float>(i) / kSteps;
      const Vec2 next = glm::mix(glm::mix(a, b, t), glm::mix(b, c, t), t);
      const Vec2 along = next - last, to = Vec2{p} - last;
      const float u = std::clamp(glm::dot(to, along) / glm::dot(along, along), 0.0f, 1.0f);
      const float d = glm::length(to - along * u);
      if (d < best_m) {
        best_m = d;
        side = along.x * to.y - along.y * to.x > 0 ? 1.0f : -1.0f;  // Left of the way down: cheek.
        share = t - (1.0f - u) / kSteps;
      }
      last = next;
    }
    if (p.z < corner_.z - 0.03f) return 0.0f;
    // A soft step beside the nose that sharpens on its way down.
    const float width_m = glm::mix(0.0030f, 0.0019f, share);
    return 0.85f * fold(side * best_m / width_m, 0.9f) * span_of(share, 0.06f, 0.84f, 0.16f);
  }

 private:
  Vec3 inner_brow_, middle_brow_, outer_brow_, hairline_, eye_, canthus_, lower_lid_, wing_,
      corner_, chin_;
};

}  // namespace

Image draw_wrinkles(const Character& character, const SkinMap& skin, float depth) {
  const Face face(character);
  Image out{character.name + "_lines", skin.side, skin.side, {}, true, true};
  out.rgba.assign(std::size_t{4} * skin.side * skin.side, 136);  // kLevel.
  for (std::size_t i = 0; i < skin.point.size(); ++i) {
    const SkinPoint& p = skin.point[i];
    if (!p.there || !p.is_outer || p.normal.z < -0.3f) continue;
    const Vec3 q = p.position_m;
    const std::array<float, 4> value = {face.forehead(q), face.glabella(q), face.crows_foot(q),
                                        face.nasolabial(q)};
    for (std::size_t k = 0; k < 4; ++k) {
      const float v = std::clamp(kLevel + 0.46f * depth * value[k], 0.0f, 1.0f);
      out.rgba[4 * i + k] = static_cast<std::uint8_t>(std::lround(255.0f * v));
    }
  }
  return out;
}

}  // namespace caryatid::bake
