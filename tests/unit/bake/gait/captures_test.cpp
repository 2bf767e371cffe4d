// On captures and streams of others: skipped without CARYATID_TEST_DATA.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "assets/bake/gait/analyse.h"
#include "core/body/pose.h"
#include "core/stream/bap_text.h"
#include "tests/support/test_data.h"

namespace caryatid::bake {
namespace {

GaitAnalysis of(const std::filesystem::path& file) {
  return analyse_gait(motion_of(read_bvh(test::read_file(file), file.filename().string())));
}

void expect_within(float value, float low, float high, float tolerance) {
  EXPECT_GE(value, low - tolerance);
  EXPECT_LE(value, high + tolerance);
}

// Ranges measured on CMU subject 02 trial 01 for the specification; 3 % of the cycle allowed.
TEST(Captures, PhasesOfARealWalk) {
  CARYATID_NEED_TEST_DATA(mocap, "mocap");
  const GaitAnalysis a = of(mocap / "cmu_02_01.bvh");
  EXPECT_FALSE(a.runs);
  EXPECT_EQ(a.mood, body::GaitMood::normal);
  EXPECT_NEAR(a.speed_mps, 1.18f, 0.05f);
  ASSERT_EQ(a.strides.size(), 3u);
  for (const Stride& t : a.strides) {
    expect_within(t.seconds, 1.08f, 1.10f, 0.02f);
    expect_within(t.length_m, 1.29f, 1.30f, 0.03f);
    expect_within(t.recoil.percent, 13.8f, 15.2f, 3.0f);
    expect_within(t.passing.percent, 27.3f, 27.7f, 3.0f);
    expect_within(t.anticipation.percent, 41.0f, 48.0f, 3.0f);
    expect_within(t.toe_off.percent, 65.0f, 66.0f, 3.0f);
  }
}

TEST(Captures, HeelStrikesOfARealWalk) {
  CARYATID_NEED_TEST_DATA(mocap, "mocap");
  const GaitAnalysis a = of(mocap / "cmu_02_01.bvh");
  const std::vector<std::size_t> left = {67, 132}, right = {34, 100, 166};
  ASSERT_EQ(a.heel_strikes[0].size(), left.size());
  ASSERT_EQ(a.heel_strikes[1].size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i)
    EXPECT_NEAR(double(a.heel_strikes[0][i]), double(left[i]), 1.0);
  for (std::size_t i = 0; i < right.size(); ++i)
    EXPECT_NEAR(double(a.heel_strikes[1][i]), double(right[i]), 1.0);
}

TEST(Captures, ARealJogIsARun) {
  CARYATID_NEED_TEST_DATA(mocap, "mocap");
  const GaitAnalysis a = of(mocap / "cmu_02_03.bvh");
  EXPECT_TRUE(a.runs);
  EXPECT_NEAR(a.speed_mps, 2.6f, 0.15f);
  EXPECT_NEAR(a.strides[0].seconds, 0.76f, 0.02f);
}

TEST(Captures, EveryBodyStreamOfOthersPlays) {
  CARYATID_NEED_TEST_DATA(streams, "streams/vreng");
  int files = 0;
  const body::Skeleton s = body::upright_skeleton();
  for (const auto& entry : std::filesystem::directory_iterator(streams)) {
    if (entry.path().extension() != ".bap") continue;
    ++files;
    const std::string text = test::read_file(entry.path());
    stream::BapTextReader reader(text);
    ASSERT_TRUE(reader.read_header().ok()) << entry.path();
    body::BapFrame frame;
    int frames = 0;
    while (reader.next(&frame).ok()) {
      ++frames;
      for (const auto convention :
           {body::BapConvention::signed_axes, body::BapConvention::plain_axes,
            body::BapConvention::signed_axes_reversed}) {
        std::vector<Affine> pose(body::kHanimJointCount);
        ASSERT_TRUE(
            (body::PoseJob{.skeleton = &s, .baps = &frame, .convention = convention, .out = pose})
                .run()
                .ok());
        for (std::size_t j = 0; j < pose.size(); ++j) {
          const Vec3 at = joint_position(s, pose, static_cast<body::HanimJoint>(j));
          ASSERT_LT(glm::length(at), 3.0f) << entry.path() << " frame " << frames;
        }
      }
    }
    EXPECT_GT(frames, 0) << entry.path();
  }
  EXPECT_EQ(files, 14);
}

TEST(Captures, ClappingHandsMeetInFrontOfTheChest) {
  CARYATID_NEED_TEST_DATA(streams, "streams/vreng");
  const std::string text = test::read_file(streams / "clap.bap");
  stream::BapTextReader reader(text);
  ASSERT_TRUE(reader.read_header().ok());
  const body::Skeleton s = body::upright_skeleton();
  body::BapFrame frame;
  std::vector<Affine> pose(body::kHanimJointCount);
  float least_m = 1.0f;
  while (reader.next(&frame).ok()) {
    ASSERT_TRUE((body::PoseJob{.skeleton = &s, .baps = &frame, .out = pose}).run().ok());
    const Vec3 left = joint_position(s, pose, body::HanimJoint::l_middle1);
    const Vec3 right = joint_position(s, pose, body::HanimJoint::r_middle1);
    if (left.y > 1.1f && left.z > 0.1f) least_m = std::min(least_m, glm::distance(left, right));
  }
  EXPECT_LT(least_m, 0.2f);
}

TEST(Captures, SittingBendsHipsForwardAndKneesBackInPlainAxes) {
  CARYATID_NEED_TEST_DATA(streams, "streams/vreng");
  const std::string text = test::read_file(streams / "sit.bap");
  stream::BapTextReader reader(text);
  ASSERT_TRUE(reader.read_header().ok());
  body::BapFrame frame;
  while (reader.next(&frame).ok()) {
  }
  const body::Skeleton s = body::upright_skeleton();
  std::vector<Affine> pose(body::kHanimJointCount);
  ASSERT_TRUE((body::PoseJob{.skeleton = &s,
                             .baps = &frame,
                             .convention = body::BapConvention::plain_axes,
                             .out = pose})
                  .run()
                  .ok());
  const Vec3 knee = joint_position(s, pose, body::HanimJoint::l_knee);
  const Vec3 ankle = joint_position(s, pose, body::HanimJoint::l_ankle);
  EXPECT_GT(knee.z, joint_position(s, pose, body::HanimJoint::l_hip).z + 0.1f);
  EXPECT_LT(ankle.z, knee.z + 0.02f);
}

}  // namespace
}  // namespace caryatid::bake
