#include "assets/bake/stream/epf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace caryatid::bake {
namespace {

AnimationClip wave() {
  AnimationClip clip;
  clip.face.resize(20);
  for (std::size_t i = 0; i < clip.face.size(); ++i) {
    clip.face[i].set(
        3, static_cast<float>(40 * std::lround(5 * std::sin(0.3 * static_cast<double>(i)))));
    clip.face[i].set(48, static_cast<float>(170 * static_cast<int>(i)));
  }
  return clip;
}

// FAP 3 of group 2 and all of group 7.
const char* const kMasks = "FMT 0  1 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0  0 0 0 0 3 0 0 0\n";

std::vector<face::FapFrame> decode(const std::vector<std::byte>& bytes,
                                   std::vector<stream::FbaPlane>* out_planes) {
  std::vector<stream::ModelNode> nodes(4096);
  stream::FbaDecoder decoder(nodes, {});
  decoder.refill(bytes, true);
  std::vector<face::FapFrame> frames;
  stream::FbaPlane plane;
  face::FapFrame face;
  body::BapFrame body;
  while (decoder.next(&plane, &face, &body).ok()) {
    frames.push_back(face);
    out_planes->push_back(plane);
  }
  return frames;
}

TEST(Epf, WritesThePlanesThatItNames) {
  const std::string text =
      std::string("# a script\nFBM 1 ISI 1 FFR 4 FRR 12 8 0 TC 1 2 1 3 FQU 1\n") + kMasks +
      "FBM 1 ISI 0 FFR 5 SKN 16\nFBM 1 FFR 6\n";
  const AnimationClip clip = wave();
  const auto bytes = encode_by_epf(clip, parse_epf(text, "a.epf"), "a.epf");
  std::vector<stream::FbaPlane> planes;
  const auto frames = decode(bytes, &planes);
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i].get(3), clip.face[4 + i].get(3));
    EXPECT_EQ(frames[i].get(48), clip.face[4 + i].get(48));
    EXPECT_EQ(frames[i].mask.count(), 4u);  // FAP 3 and the whole group of the head.
  }
  EXPECT_TRUE(planes[0].has_time_code && planes[0].intra);
  EXPECT_EQ(planes[0].rate, (stream::FbaRate{12, 8, false}));
  EXPECT_EQ(planes[0].time_code, (stream::FbaTimeCode{1, 2, 3}));
  EXPECT_EQ(planes[1].skip, 16u);
  EXPECT_EQ(planes[2].skip, 0u);  // Skipping does not stay.
  EXPECT_FALSE(planes[2].intra);  // ISI does.
}

void expect_fault(const std::string& text, const char* message) {
  try {
    encode_by_epf(wave(), parse_epf(text, "a.epf"), "a.epf");
    ADD_FAILURE() << "accepted: " << text;
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(message)) << text;
  }
}

TEST(Epf, FaultsNameTheLine) {
  expect_fault("", "a.epf:1: no plane");
  expect_fault("FBM 1\nXYZ 3\n", "a.epf:2: unknown tag 'XYZ'");
  expect_fault("FBM 4\n", "a.epf:1: '4' is not a number in 0..3");
  expect_fault("FBM 1 FQU\n", "ends within a tag");
  expect_fault("FBM 2 BMT 2\n", "type 2 does not exist");
  expect_fault("FBM 1 FFR 20\n", "no such frame");
  expect_fault("FBM 1 ISI 1\nFBM 1 ISI 0 FQU 3\n", "a.epf:2: masks, quantisers");
}

}  // namespace
}  // namespace caryatid::bake
