#include "core/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace caryatid::scene {
namespace {

Vec3 to_ndc(const Camera& c, Vec3 world_m) {
  const Vec4 clip = c.projection * c.view * Vec4{world_m, 1.0f};
  return Vec3{clip} / clip.w;
}

constexpr View kViews[] = {View::head,  View::bust,          View::body, View::left,
                           View::right, View::three_quarter, View::feet};

TEST(Camera, TargetStandsInTheMiddleOfEveryView) {
  for (const View view : kViews) {
    const Framing f = framing(view, Subject{});
    const Vec3 p = to_ndc(make_camera(f, 1.6f), f.target_m);
    EXPECT_NEAR(p.x, 0.0f, 1e-5f);
    EXPECT_NEAR(p.y, 0.0f, 1e-5f);
    EXPECT_GT(p.z, -1.0f);
    EXPECT_LT(p.z, 1.0f);
  }
}

TEST(Camera, BodyViewHoldsTheWholePersonInEveryFormat) {
  const Subject subject{{0, 1.75f, 0.1f}, 1.88f};
  for (const float aspect : {0.56f, 1.0f, 1.78f}) {
    const Camera c = make_camera(framing(View::body, subject), aspect);
    EXPECT_LT(to_ndc(c, {0, subject.stature_m, 0}).y, 1.0f);
    EXPECT_GT(to_ndc(c, {0, 0, 0.1f}).y, -1.0f);
    EXPECT_LT(to_ndc(c, {0.35f, 1.0f, 0}).x, 1.0f);
  }
}

TEST(Camera, LeftViewSeesTheFigureFromItsLeft) {
  EXPECT_GT(make_camera(framing(View::left, Subject{}), 1.0f).position_m.x, 0.5f);
  EXPECT_LT(make_camera(framing(View::right, Subject{}), 1.0f).position_m.x, -0.5f);
}

// The figure's left is on the right of the picture when it looks at us.
TEST(Camera, FrontViewIsNotMirrored) {
  const Camera c = make_camera(framing(View::head, Subject{}), 1.0f);
  EXPECT_GT(to_ndc(c, {0.1f, 1.6f, 0.1f}).x, 0.0f);
  EXPECT_GT(to_ndc(c, {0, 1.7f, 0.1f}).y, 0.0f);
}

TEST(Camera, NearerIsInFront) {
  const Camera c = make_camera(framing(View::head, Subject{}), 1.0f);
  EXPECT_LT(to_ndc(c, {0, 1.6f, 0.1f}).z, to_ndc(c, {0, 1.6f, -0.1f}).z);
}

TEST(Camera, TurnedPanelShowsTheSamePictureTurned) {
  const Framing f = framing(View::bust, Subject{});
  const Vec3 p{0.07f, 1.65f, 0.1f};
  const Vec3 upright = to_ndc(make_camera(f, 0.6f, 0), p);
  const Vec3 turned = to_ndc(make_camera(f, 1.0f / 0.6f, 90), p);
  EXPECT_NEAR(turned.x, upright.y, 1e-4f);
  EXPECT_NEAR(turned.y, -upright.x, 1e-4f);
  const Vec3 over = to_ndc(make_camera(f, 0.6f, 180), p);
  EXPECT_NEAR(over.x, -upright.x, 1e-4f);
  EXPECT_NEAR(over.y, -upright.y, 1e-4f);
}

TEST(Camera, BlendMeetsBothEnds) {
  const Framing a = framing(View::head, Subject{}), b = framing(View::body, Subject{});
  EXPECT_FLOAT_EQ(blend(a, b, 0.0f).visible_height_m, a.visible_height_m);
  EXPECT_FLOAT_EQ(blend(a, b, 1.0f).target_m.y, b.target_m.y);
  EXPECT_NEAR(glm::length(blend(a, b, 0.4f).direction), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace caryatid::scene
