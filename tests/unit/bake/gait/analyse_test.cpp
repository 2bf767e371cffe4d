#include "assets/bake/gait/analyse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "core/body/pose.h"
#include "core/body/walker.h"
#include "core/stream/bap_text.h"
#include "tests/support/test_data.h"

namespace caryatid::bake {
namespace {

std::vector<body::BapFrame> walked(const body::GaitStyle& style, int count, float fps) {
  const body::Skeleton s = body::upright_skeleton();
  body::Walker walker(&s);
  walker.set_style(style);
  walker.walk_to({0, 1000});
  std::vector<body::BapFrame> frames;
  body::BapFrame frame;
  for (int i = 0; i < 200; ++i) walker.step(1.0f / 30.0f, frame);
  for (int i = 0; i < count; ++i) {
    walker.step(1.0f / fps, frame);
    frames.push_back(frame);
  }
  return frames;
}

GaitAnalysis of(body::GaitMood mood) {
  return analyse_gait(
      motion_of(body::upright_skeleton(), walked(body::gait_style(mood), 480, 60.0f), 60.0f));
}

TEST(Analyse, FindsThePhasesOfOurOwnWalk) {
  const GaitAnalysis a = of(body::GaitMood::normal);
  EXPECT_FALSE(a.runs);
  ASSERT_GE(a.strides.size(), 8u);
  for (const Stride& t : a.strides) {
    EXPECT_NEAR(t.seconds, 32.0f / 30.0f, 0.03f);
    EXPECT_NEAR(t.recoil.percent, 14.0f, 4.0f);
    EXPECT_NEAR(t.passing.percent, 25.0f, 4.0f);
    EXPECT_NEAR(t.toe_off.percent, 62.0f, 5.0f);
    EXPECT_FALSE(t.recoil.nominal);
    EXPECT_FALSE(t.passing.nominal);
  }
}

TEST(Analyse, GivesTheStyleBackFromItsWalk) {
  const GaitAnalysis a = of(body::GaitMood::normal);
  const body::GaitStyle& wanted = body::gait_style(body::GaitMood::normal);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(a.style.stance_thigh_deg[k], wanted.stance_thigh_deg[k], 4.0f);
    EXPECT_NEAR(a.style.stance_knee_deg[k], wanted.stance_knee_deg[k], 5.0f);
  }
  EXPECT_LT(a.knee_rms_deg, 6.0f);
  EXPECT_LT(a.thigh_rms_deg, 4.0f);
}

TEST(Analyse, NamesMostMoods) {
  int right = 0;
  for (int m = 0; m < body::kGaitMoodCount; ++m)
    right += of(body::GaitMood(m)).mood == body::GaitMood(m) ? 1 : 0;
  EXPECT_GE(right, 7);
}

TEST(Analyse, TellsARunFromAWalk) {
  const GaitAnalysis a = analyse_gait(
      motion_of(body::upright_skeleton(), walked(body::running_style(), 300, 60.0f), 60.0f));
  EXPECT_TRUE(a.runs);
  EXPECT_GT(a.speed_mps, 2.0f);
}

TEST(Analyse, RefusesWhatHasNoStride) {
  const std::vector<body::BapFrame> still(100);
  EXPECT_THROW(analyse_gait(motion_of(body::upright_skeleton(), still, 30.0f)), std::runtime_error);
  EXPECT_THROW(analyse_gait(Motion{}), std::runtime_error);
}

TEST(Analyse, NormalWalkLiesWithinTheNorm) {
  const NormativeFit fit = fit_to_norm(walked_curves(body::gait_style(body::GaitMood::normal)));
  EXPECT_GE(fit.hip, 0.9f);
  EXPECT_GE(fit.knee, 0.9f);
  EXPECT_GE(fit.ankle, 0.9f);
  EXPECT_GE(fit.list, 0.9f);
  EXPECT_GE(fit.rotation, 0.9f);
}

TEST(Analyse, ReadsAngleCurves) {
  std::string text = "time_s,l_thigh,l_knee,l_ankle,r_thigh,r_knee,r_ankle\n";
  const CycleCurves c = walked_curves(body::gait_style(body::GaitMood::normal));
  for (int i = 0; i < 200; ++i) {
    const auto l = static_cast<std::size_t>(i % 50), r = static_cast<std::size_t>((i + 25) % 50);
    for (const float v :
         {static_cast<float>(i) / 50.0f, c.thigh[l], c.knee[l], c.ankle[l], c.thigh[r], c.knee[r]})
      text += std::to_string(v) + ",";
    text += std::to_string(c.ankle[r]) + "\n";
  }
  const GaitAnalysis a = analyse_gait(motion_of_csv(text, "x.csv"));
  EXPECT_NEAR(a.strides[0].seconds, 1.0f, 0.05f);
  EXPECT_NEAR(a.strides[0].passing.percent, 25.0f, 4.0f);
}

TEST(Analyse, NamesTheLineOfABadAngle) {
  try {
    motion_of_csv("time_s,l_thigh,l_knee,l_ankle,r_thigh,r_knee,r_ankle\n0,1,2,3,4,5,x\n", "a.csv");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("a.csv:2:"), std::string::npos);
  }
}

constexpr const char* kTinyBvh =
    "HIERARCHY\nROOT Hips\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation "
    "Yrotation Xrotation\n JOINT LeftUpLeg\n {\n  OFFSET 0.1 0 0\n  CHANNELS 3 Zrotation Yrotation "
    "Xrotation\n  End Site\n  {\n   OFFSET 0 -1 0\n  }\n }\n}\nMOTION\nFrames: 2\nFrame Time: "
    "0.0333\n"
    "0 1 0 0 0 0 0 0 90\n0 1 0 0 90 0 0 0 0\n";

TEST(Bvh, PlacesJoints) {
  const Bvh bvh = read_bvh(kTinyBvh, "tiny.bvh");
  ASSERT_EQ(bvh.joints.size(), 3u);
  const auto first = bvh.positions(0);  // The thigh turns 90 degrees about X: down becomes back.
  EXPECT_NEAR(first[2].x, 0.1f, 1e-5f);
  EXPECT_NEAR(first[2].y, 1.0f, 1e-5f);
  EXPECT_NEAR(first[2].z, -1.0f, 1e-5f);
  const auto second = bvh.positions(1);  // The root turns 90 degrees about Y: left becomes back.
  EXPECT_NEAR(second[1].z, -0.1f, 1e-5f);
}

TEST(Bvh, ACutFileIsRefusedWithItsLine) {
  const std::string whole = kTinyBvh;
  for (std::size_t n = 0; n + 3 < whole.size(); ++n) {
    try {
      read_bvh(whole.substr(0, n), "cut.bvh");
      FAIL() << n;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string(e.what()).rfind("cut.bvh:", 0), 0u);
    }
  }
}

TEST(Bvh, HostileFilesAreRefused) {
  const std::string whole = kTinyBvh;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& bad :
       {with("Frames: 2", "Frames: 999999999"), with("Frames: 2", "Frames: -1"),
        with("Frames: 2", "Frames: 900000"), with("0.0333", "nan"), with("0.0333", "0"),
        with("CHANNELS 3", "CHANNELS 77"), with("Zrotation", "Qrotation"),
        with("0.1 0 0", "inf 0 0"), with("90\n", "1e300\n")})
    EXPECT_THROW(read_bvh(bad, "bad.bvh"), std::runtime_error) << bad;
  std::string deep = "HIERARCHY ROOT a ";
  for (int i = 0; i < 10000; ++i) deep += "{ OFFSET 0 0 0 JOINT b ";
  EXPECT_THROW(read_bvh(deep, "deep.bvh"), std::runtime_error);
}

TEST(Bvh, RandomBytesNeverDoMoreThanThrow) {
  unsigned seed = 7;
  for (int round = 0; round < 3000; ++round) {
    std::string text = kTinyBvh;
    for (int k = 0; k < 3; ++k) {
      seed = seed * 1664525u + 1013904223u;
      text[(seed >> 8) % text.size()] = static_cast<char>(seed >> 24);
    }
    try {
      const Bvh bvh = read_bvh(text, "x.bvh");
      for (std::size_t f = 0; f < bvh.frame_count; ++f) (void)bvh.positions(f);
    } catch (const std::runtime_error&) {
    }
  }
}

}  // namespace
}  // namespace caryatid::bake
