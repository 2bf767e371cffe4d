#include "core/body/gesture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/body/pose.h"
#include "core/body/walker.h"

namespace caryatid::body {
namespace {

struct Stage {
  Skeleton skeleton = upright_skeleton();
  Walker walker{&skeleton};
  GestureLayer layer;
  BapFrame shown;
  std::array<Affine, kHanimJointCount> pose;

  void run(float seconds) {
    BapFrame body;
    for (float t = 0.0f; t < seconds; t += 1.0f / 60.0f) {
      walker.step(1.0f / 60.0f, body);
      layer.step(1.0f / 60.0f);
      shown = body;
      layer.apply(skeleton, shown);
    }
    ASSERT_TRUE((PoseJob{.skeleton = &skeleton, .baps = &shown, .out = pose}).run().ok());
  }
  Vec3 at(HanimJoint j) const { return joint_position(skeleton, pose, j); }
};

TEST(Gesture, AWavingHandIsBesideTheHeadWithItsPalmToTheVisitor) {
  Stage stage;
  stage.layer.start({.kind = GestureKind::wave});
  stage.run(1.2f);
  EXPECT_GT(stage.at(HanimJoint::r_wrist).y, stage.at(HanimJoint::r_shoulder).y);
  EXPECT_LT(stage.at(HanimJoint::r_wrist).x, stage.at(HanimJoint::skullbase).x - 0.15f);
  EXPECT_LT(stage.at(HanimJoint::r_elbow).y, stage.at(HanimJoint::r_shoulder).y);
  // The palm of the right hand faces +X at rest.
  EXPECT_GT(stage.pose[index_of(HanimJoint::r_wrist)].direction({1, 0, 0}).z, 0.7f);
}

TEST(Gesture, APointingArmAimsAtItsTarget) {
  for (const bool left : {true, false}) {
    Stage stage;
    const Vec3 target{left ? 1.0f : -1.0f, 1.7f, 1.2f};
    stage.layer.start({.kind = GestureKind::point, .left = left, .target_m = target});
    stage.run(1.0f);
    const Vec3 shoulder = stage.at(left ? HanimJoint::l_shoulder : HanimJoint::r_shoulder);
    const Vec3 wrist = stage.at(left ? HanimJoint::l_wrist : HanimJoint::r_wrist);
    EXPECT_GT(glm::dot(glm::normalize(wrist - shoulder), glm::normalize(target - shoulder)), 0.99f);
  }
}

TEST(Gesture, EveryGestureEndsAndLeavesTheBodyAsItWas) {
  for (int k = 1; k <= 6; ++k) {
    Stage with, without;
    with.layer.start({.kind = static_cast<GestureKind>(k)});
    with.run(5.0f);
    without.run(5.0f);
    EXPECT_FALSE(with.layer.active());
    EXPECT_EQ(with.shown.value, without.shown.value) << k;
  }
}

TEST(Gesture, NothingJumpsEvenWhenOneInterruptsAnother) {
  Stage stage;
  stage.walker.walk_to({0, 5});
  BapFrame before = stage.shown;
  stage.run(0.02f);
  before = stage.shown;
  for (int i = 0; i < 600; ++i) {
    if (i % 45 == 0) stage.layer.start({.kind = static_cast<GestureKind>(1 + (i / 45) % 6)});
    stage.run(1.0f / 120.0f);
    for (int bap = 24; bap <= 180; ++bap) {
      const float turn = std::abs(stage.shown.get(bap) - before.get(bap));
      EXPECT_LT(turn, 40000.0f) << gesture_name(stage.layer.kind()) << " bap " << bap;
    }
    before = stage.shown;
  }
}

TEST(Gesture, LegsWalkOnUndisturbed) {
  Stage with, without;
  with.walker.walk_to({0, 5});
  without.walker.walk_to({0, 5});
  with.layer.start({.kind = GestureKind::wave});
  with.run(1.5f);
  without.run(1.5f);
  for (int bap = 1; bap <= 23; ++bap) EXPECT_EQ(with.shown.get(bap), without.shown.get(bap));
}

}  // namespace
}  // namespace caryatid::body
