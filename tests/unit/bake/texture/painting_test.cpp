#include <gtest/gtest.h>

#include "assets/bake/texture/brow.h"
#include "assets/bake/texture/eye.h"
#include "assets/bake/texture/hairline.h"
#include "assets/bake/texture/teeth.h"
#include "assets/bake/texture/wrinkles.h"

namespace caryatid::bake {
namespace {

float grey_of(Vec4 t) { return (t.x + t.y + t.z) / 3.0f; }

// Mean brightness on a circle about the upper right eye of the layout, radius in irises.
float ring_of(const LinearImage& image, float irises) {
  float sum = 0.0f;
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const float a = 6.2831853f * static_cast<float>(i) / kSteps;
    const Vec2 uv = Vec2{0.703f, 0.297f} + 0.114f * irises * Vec2{std::cos(a), std::sin(a)};
    sum += grey_of(sample_bilinear(image, uv)) / kSteps;
  }
  return sum;
}

TEST(Eyes, PupilIsBlackAndTheIrisEndsInADarkRing) {
  LinearImage image(256, 256, Vec4{0.6f, 0.6f, 0.6f, 1.0f});
  paint_eyes({0.35f, 0.38f, 0.42f}, image);
  EXPECT_LT(ring_of(image, 0.2f), 0.01f);
  EXPECT_GT(ring_of(image, 0.6f), 0.05f);
  EXPECT_LT(ring_of(image, 0.96f), 0.6f * ring_of(image, 0.6f));
  EXPECT_GT(ring_of(image, 1.3f), 2.0f * ring_of(image, 0.6f));
}

TEST(Eyes, WhiteDarkensTowardsTheCorners) {
  LinearImage image(256, 256, Vec4{0.6f, 0.6f, 0.6f, 1.0f});
  paint_eyes({0.35f, 0.38f, 0.42f}, image);
  EXPECT_LT(ring_of(image, 2.2f), ring_of(image, 1.3f));
}

TEST(Brows, ThinAtTheirHeadsOnly) {
  Proxy brow;
  brow.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  brow.quads = {{{0, 1, 2, 3}, {0, 1, 2, 3}, 0}};
  const std::vector<Vec3> position_m = {
      {0.01f, 0, 0}, {0.06f, 0, 0}, {0.06f, 0.01f, 0}, {0.01f, 0.01f, 0}};
  LinearImage image(64, 64, Vec4{0.1f, 0.1f, 0.1f, 0.5f});
  thin_heads(brow, position_m, image);
  EXPECT_LT(image.at(1, 32).w, 0.1f);
  EXPECT_FLOAT_EQ(image.at(40, 32).w, 0.5f);
}

// A flat head of 10 cm under a style that covers its upper half, 5 mm above it.
struct FlatHead {
  Character character;
  SkinMap skin{128, std::vector<SkinPoint>(128 * 128)};
  LinearImage atlas{128, 128, Vec4{1.0f}};

  FlatHead() {
    for (std::uint32_t y = 0; y < 128; ++y)
      for (std::uint32_t x = 0; x < 128; ++x) {
        SkinPoint& p = skin.point[y * 128 + x];
        p.position_m =
            0.1f / 128.0f * Vec3{static_cast<float>(x), 128.0f - static_cast<float>(y), 0};
        p.normal = {0, 0, 1};
        p.is_outer = p.there = true;
      }
    Object hair;
    hair.role = pack::ObjectRole::hair;
    hair.mesh.position_m = {
        {0, 0.05f, 0.005f}, {0.1f, 0.05f, 0.005f}, {0.1f, 0.1f, 0.005f}, {0, 0.1f, 0.005f}};
    hair.mesh.uv.assign(4, Vec2{0.5f});
    hair.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    character.objects.push_back(hair);
    pack::Material material{};
    character.materials.push_back(material);
    character.images.push_back(to_srgb(LinearImage(4, 4, Vec4{0.02f, 0.02f, 0.02f, 1}), "hair"));
  }
};

TEST(Hairline, RootsAreUnderTheStyleAndBareSkinBeyondItsReach) {
  FlatHead head;
  paint_hairline(head.character, head.skin, 0.01f, head.atlas);
  for (std::uint32_t x = 4; x < 124; ++x) {
    EXPECT_LT(grey_of(head.atlas.at(x, 20)), 0.15f) << x;
    EXPECT_EQ(grey_of(head.atlas.at(x, 100)), 1.0f) << x;
  }
}

TEST(Hairline, ThinsOutAcrossTheEdge) {
  FlatHead head;
  paint_hairline(head.character, head.skin, 0.01f, head.atlas);
  const auto row = [&](std::uint32_t y) {
    float sum = 0.0f;
    for (std::uint32_t x = 4; x < 124; ++x) sum += grey_of(head.atlas.at(x, y)) / 120.0f;
    return sum;
  };
  EXPECT_LT(row(62), row(68));
  EXPECT_LT(row(68), row(73));
}

TEST(Hairline, NothingIsPaintedWithoutHair) {
  FlatHead head;
  head.character.objects.clear();
  paint_hairline(head.character, head.skin, 0.01f, head.atlas);
  for (const Vec4& t : head.atlas.texel) ASSERT_EQ(grey_of(t), 1.0f);
}

TEST(Teeth, GreyTurnsToIvoryAndRedToPink) {
  LinearImage image(2, 1, Vec4{0.3f, 0.3f, 0.3f, 1});
  image.at(1, 0) = {0.20f, 0.02f, 0.02f, 1};
  paint_teeth(image);
  const Vec4 tooth = image.at(0, 0), gum = image.at(1, 0);
  EXPECT_GT(grey_of(tooth), 0.45f);
  EXPECT_GT(tooth.x, tooth.z);
  EXPECT_GT(gum.x, 1.8f * gum.y);
  EXPECT_LT(grey_of(gum), grey_of(tooth));
}

// A face drawn on a plane, 16 cm wide and high, its middle between the eyes.
struct FlatFace {
  Character character;
  SkinMap skin{128, std::vector<SkinPoint>(128 * 128)};

  FlatFace() {
    for (std::uint32_t y = 0; y < 128; ++y)
      for (std::uint32_t x = 0; x < 128; ++x) {
        SkinPoint& p = skin.point[y * 128 + x];
        p.position_m = {0.08f - 0.16f / 128 * (static_cast<float>(x) + 0.5f),
                        0.08f - 0.16f / 128 * (static_cast<float>(y) + 0.5f), 0};
        p.normal = {0, 0, 1};
        p.is_outer = p.there = true;
      }
    const auto point = [this](std::uint8_t group, std::uint8_t index, float x_m, float y_m) {
      character.feature_points.push_back({group, index, 0, 0, {x_m, y_m, 0}});
    };
    point(4, 1, 0.012f, 0.018f), point(4, 3, 0.030f, 0.022f), point(4, 5, 0.048f, 0.018f);
    point(11, 1, 0, 0.075f), point(3, 5, 0.032f, 0), point(3, 7, 0.048f, 0);
    point(3, 9, 0.032f, -0.006f), point(9, 1, 0.018f, -0.035f), point(8, 3, 0.026f, -0.06f);
    point(2, 1, 0, -0.08f);
  }
  // How far channel `k` leaves the level in rows of the picture.
  int relief(const Image& lines, std::size_t k, std::uint32_t first, std::uint32_t last) const {
    int most = 0;
    for (std::uint32_t i = 128 * first; i < 128 * last; ++i)
      most = std::max(most, std::abs(lines.rgba[4 * i + k] - 136));
    return most;
  }
};

TEST(Wrinkles, LieWhereTheMusclesFold) {
  const FlatFace face;
  const Image lines = draw_wrinkles(face.character, face.skin, 1.0f);
  EXPECT_TRUE(lines.is_data);
  EXPECT_GT(face.relief(lines, 0, 5, 45), 60);   // Rows on the forehead.
  EXPECT_LT(face.relief(lines, 0, 70, 128), 3);  // None below the eyes.
  EXPECT_GT(face.relief(lines, 1, 40, 64), 60);
  EXPECT_LT(face.relief(lines, 1, 80, 128), 3);
  EXPECT_GT(face.relief(lines, 2, 55, 80), 40);
  EXPECT_LT(face.relief(lines, 3, 0, 80), 6);
  EXPECT_GT(face.relief(lines, 3, 90, 110), 60);
}

TEST(Wrinkles, AreAlikeOnBothSidesButForTheForehead) {
  const FlatFace face;
  const Image lines = draw_wrinkles(face.character, face.skin, 1.0f);
  for (std::uint32_t y = 0; y < 128; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      for (const std::size_t k : {2, 3})
        ASSERT_EQ(lines.rgba[4 * (128 * y + x) + k], lines.rgba[4 * (128 * y + 127 - x) + k]);
}

TEST(Wrinkles, NoDepthIsLevel) {
  const FlatFace face;
  for (const std::uint8_t v : draw_wrinkles(face.character, face.skin, 0.0f).rgba)
    ASSERT_EQ(v, 136);
}

}  // namespace
}  // namespace caryatid::bake
