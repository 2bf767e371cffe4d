#include "assets/bake/texture/eye.h"

#include "assets/bake/texture/atlas.h"

namespace caryatid::bake {
namespace {

// Where the base's eye textures have their irises.
constexpr Vec2 kCenters[] = {{0.703f, 0.297f}, {0.290f, 0.706f}};
constexpr float kIris = 0.114f;    // Radius, of the image.
constexpr float kPupil = 0.32f;    // Radius, of the iris.
constexpr float kVisible = 0.27f;  // Radius of the white that lids ever uncover.

// Darker than any other place of the eye by far: the bake finds the gaze by it.
constexpr Vec3 kBlack{0.0005f};

// r: 0 the middle, 1 the rim of the iris. direction: unit, y downwards.
Vec3 iris_color(Vec3 base, float r, Vec2 direction) {
  const Vec3 around{direction.x, direction.y, 0.0f};
  const float coarse = noise(around * 9.0f + Vec3{0, 0, r * 2.5f});
  const float fine = noise(around * 26.0f + Vec3{5.0f, 1.0f, r * 4.0f});
  Vec3 c = base * std::max(0.95f + 0.28f * coarse + 0.30f * fine, 0.6f);
  const float collar = std::exp(-std::pow((r - 0.50f) / 0.10f, 2.0f));
  c *= 1.0f + 0.45f * collar * (0.6f + 0.4f * fine);
  c = glm::mix(c, c * Vec3{1.30f, 1.02f, 0.72f}, smooth_step(0.62f, 0.40f, r));
  c *= 1.0f + 0.25f * direction.y * smooth_step(0.3f, 0.7f, r);
  c *= glm::mix(1.0f, 0.34f, smooth_step(0.74f, 0.98f, r));  // The limbal ring.
  return glm::mix(c, kBlack, smooth_step(kPupil + 0.035f, kPupil - 0.02f, r));
}

// From the limbus, which shades it a little, to the corners, where it is red and sees less light.
Vec3 white_color(Vec3 base, float r) {
  const float grey = glm::dot(base, Vec3{0.2126f, 0.7152f, 0.0722f});
  Vec3 c = glm::mix(Vec3{grey}, base, 0.85f) * Vec3{0.80f, 0.78f, 0.76f};
  c *= glm::mix(0.70f, 1.0f, smooth_step(0.98f, 1.25f, r));
  return c *
         glm::mix(Vec3{1.0f}, Vec3{0.74f, 0.56f, 0.53f}, smooth_step(1.3f, kVisible / kIris, r));
}

}  // namespace

void paint_eyes(Vec3 iris, LinearImage& image) {
  const Vec3 base{srgb_to_linear(iris.x), srgb_to_linear(iris.y), srgb_to_linear(iris.z)};
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const Vec2 uv{(static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height)};
      Vec2 d = uv - kCenters[0];
      if (glm::length(uv - kCenters[1]) < glm::length(d)) d = uv - kCenters[1];
      const float r = glm::length(d) / kIris;
      Vec4& texel = image.at(x, y);
      const Vec3 ball = white_color(Vec3{texel}, r);
      const Vec3 color = r < 1e-4f ? kBlack : iris_color(base, r, d / (r * kIris));
      texel = Vec4{glm::mix(color, ball, smooth_step(0.96f, 1.08f, r)), texel.w};
    }
}

}  // namespace caryatid::bake
