#include "core/agent/layout.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/scene/camera.h"

namespace caryatid::agent {
namespace {

using scene::Box;

constexpr float kSizes[][2] = {{800, 480}, {480, 800},  {1280, 720}, {1920, 1080}, {320, 240},
                               {240, 320}, {1024, 600}, {720, 720},  {200, 160}};

bool inside(const Box& box, float width, float height) {
  return box.x0 >= 0 && box.y0 >= 0 && box.x1 <= width && box.y1 <= height && !box.empty();
}

TEST(Layout, NothingOverlapsAndAllIsOnThePicture) {
  for (const auto& [w, h] : kSizes)
    for (const bool large : {false, true}) {
      const Layout l = lay_out({w, h, true, large});
      SCOPED_TRACE(testing::Message() << w << "x" << h << (large ? " large" : ""));
      EXPECT_TRUE(inside(l.card, w, h) && inside(l.caption, w, h) && inside(l.person, w, h));
      EXPECT_FALSE(l.card.overlaps(l.person) || l.card.overlaps(l.caption));
      EXPECT_GT(l.person.height(), 0.25f * h);
      EXPECT_GT(l.person.width(), 0.4f * w);
    }
}

TEST(Layout, TheCardCanStandOnTheOtherSide) {
  const Layout right = lay_out({800, 480, true, false});
  const Layout left = lay_out({800, 480, true, false, true});
  EXPECT_LT(left.card.x1, right.card.x0);
  EXPECT_GE(left.person.x0, left.card.x1);
  EXPECT_FLOAT_EQ(left.person.width(), right.person.width());
}

TEST(Layout, LargeTextIsLarger) {
  const Layout small = lay_out({800, 480, true, false}), large = lay_out({800, 480, true, true});
  EXPECT_GE(large.text_px, 1.3f * small.text_px);
  EXPECT_GE(large.caption_px, 1.3f * small.caption_px);
}

TEST(Layout, WithoutACardThePersonHasThePictureButForCaptions) {
  LayoutRequest request{.card = false, .captions = false};
  EXPECT_EQ(lay_out(request).person, (Box{0, 0, 800, 480}));
  request.captions = true;
  const Layout l = lay_out(request);
  EXPECT_EQ(l.person, (Box{0, 0, 800, l.caption.y0}));
  EXPECT_TRUE(l.card.empty());
}

// A head that fills the picture: the camera has yet to make room.
TEST(Layout, CaptionsWaitWhereTheHeadIsEverywhere) {
  const Layout l = lay_out({.card = false});
  EXPECT_TRUE(caption_box(l, 2, 600, {200, 50, 600, 470}).empty());
}

// On any display that a kiosk has (and on tiny pictures where the camera has put her).
TEST(Layout, CaptionsNeverCoverTheHead) {
  for (const auto& [w, h] : kSizes)
    for (const bool large : {false, true}) {
      const Layout l = lay_out({w, h, true, large});
      const bool anywhere = std::min(w, h) >= 480 && !large;
      const Box room = anywhere ? Box{0, 0, w, h} : l.person;
      const float side = 0.45f * room.height();
      for (float y = room.y0; y + side <= room.y1; y += 0.05f * h) {
        const Box head{room.x0, y, room.x1, y + side};
        const Box box = caption_box(l, l.caption_lines, 0.8f * w, head);
        EXPECT_TRUE(inside(box, w, h));
        EXPECT_FALSE(box.overlaps(head)) << w << "x" << h << " at " << y;
      }
    }
}

// The camera puts the whole head into the person's part of the picture: crown, chin and ears of a
// large head, as framing(View::head) sees it.
TEST(Layout, TheHeadStaysInThePersonsPart) {
  scene::Subject subject;
  const scene::Framing framing = scene::framing(scene::View::head, subject);
  for (const auto& [w, h] : kSizes)
    for (const std::uint32_t turn : {0u, 90u, 180u, 270u}) {
      const Layout l = lay_out({w, h, true, true});
      const Box& p = l.person;
      const bool sideways = turn % 180 != 0;
      const scene::Camera camera = scene::make_camera(framing, sideways ? h / w : w / h, turn,
                                                      {p.x0 / w, p.y0 / h, p.x1 / w, p.y1 / h});
      for (const Vec3 offset : {Vec3{0, 0.12f, -0.05f}, Vec3{0, -0.12f, 0.02f},
                                Vec3{0.09f, 0, -0.05f}, Vec3{-0.09f, 0, -0.05f}}) {
        const Vec3 at = scene::seen_at(camera, subject.eyes_m + offset, w, h, turn);
        EXPECT_GT(at.z, 0.0f);
        EXPECT_TRUE(at.x > p.x0 && at.x < p.x1 && at.y > p.y0 && at.y < p.y1)
            << w << "x" << h << " turned " << turn << ": " << at.x << ", " << at.y;
      }
    }
}

}  // namespace
}  // namespace caryatid::agent
