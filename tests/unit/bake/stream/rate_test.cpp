// The figures of the streams: an expressive talking minute at 25 frames a second within 2 kbit/s.
#include <gtest/gtest.h>

#include <filesystem>

#include "assets/bake/files/files.h"
#include "assets/bake/stream/clip_files.h"
#include "assets/bake/stream/rate_plot.h"
#include "assets/bake/stream/talking_track.h"
#include "tests/support/test_data.h"

namespace caryatid::bake {
namespace {

struct Outcome {
  double kbit_per_s = 0.0;
  PointError error;
};

Outcome at_rate(const AnimationClip& clip, double kbit_per_s, std::size_t intra_every) {
  std::vector<stream::ModelNode> nodes(1 << 18);
  stream::FbaSettings settings;
  settings.rate = rate_of(clip.frames_per_second);
  settings.repeat_ranges = false;
  stream::RatePlan plan;
  EXPECT_TRUE(stream::plan_rate(clip.view(intra_every), kbit_per_s, nodes, &settings, &plan).ok());
  const std::string path = (std::filesystem::path(::testing::TempDir()) / "rate_test.fba").string();
  const auto bytes = encode_fba(clip, intra_every, settings);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  FbaReport report;
  const AnimationClip back = read_fba(path, {}, &report);
  std::filesystem::remove(path);
  EXPECT_EQ(report.planes, clip.size());
  const double bits = static_cast<double>(bytes.size()) * 8.0;
  return {bits / 1000.0 / report.seconds, point_error(clip.face, back.face)};
}

TEST(Rate, TalkingMinuteIn2KilobitsPerSecond) {
  AnimationClip clip;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    clip.face = make_talking_track(60.0, 25.0, seed);
    const Outcome got = at_rate(clip, 2.0, 0);
    EXPECT_LE(got.kbit_per_s, 2.0);
    EXPECT_LE(got.error.mean_mm, 0.3);
    EXPECT_LE(got.error.p99_mm, 1.0);
    EXPECT_GT(got.error.mean_mm, 0.0);
  }
}

TEST(Rate, StillHoldsWithAnIntraPlaneEveryTenSeconds) {
  AnimationClip clip;
  clip.face = make_talking_track(60.0, 25.0, 1);
  const Outcome got = at_rate(clip, 2.0, 250);
  EXPECT_LE(got.kbit_per_s, 2.0);
  EXPECT_LE(got.error.mean_mm, 0.3);
  EXPECT_LE(got.error.p99_mm, 1.0);
}

TEST(Rate, JagOfOthersIn2KilobitsPerSecond) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vreng");
  AnimationClip clip;
  read_text((folder / "jag.fap").string(), &clip);
  const Outcome got = at_rate(clip, 2.0, 0);
  EXPECT_LE(got.kbit_per_s, 2.0);
  EXPECT_LE(got.error.mean_mm, 0.3);
  EXPECT_LE(got.error.p99_mm, 1.0);
}

TEST(Rate, TheSameSeedTalksTheSame) {
  const auto a = make_talking_track(5.0, 25.0, 9), b = make_talking_track(5.0, 25.0, 9);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].value, b[i].value);
}

// The track is worth measuring: lips open and close several times a second, the eyes blink, the
// head and the brows move.
TEST(Rate, TheTrackMoves) {
  const auto track = make_talking_track(60.0, 25.0, 1);
  int jaw_turns = 0, blinks = 0;
  for (std::size_t i = 2; i < track.size(); ++i) {
    const auto jaw = [&](std::size_t k) { return track[k].get(3); };
    jaw_turns += (jaw(i) - jaw(i - 1)) * (jaw(i - 1) - jaw(i - 2)) < 0 ? 1 : 0;
    blinks += track[i].get(19) > 600 && track[i - 1].get(19) <= 600 ? 1 : 0;
  }
  EXPECT_GT(jaw_turns, 60 * 3);
  EXPECT_GT(blinks, 10);
  EXPECT_LT(blinks, 40);
}

TEST(Rate, OfFramesASecond) {
  EXPECT_EQ(rate_of(25.0), (stream::FbaRate{25, 0, false}));
  EXPECT_EQ(rate_of(12.5), (stream::FbaRate{12, 8, false}));
  EXPECT_EQ(rate_of(29.97), (stream::FbaRate{30, 0, true}));
}

TEST(Rate, TextOfOthersSurvivesTheWayThroughAStream) {
  CARYATID_NEED_TEST_DATA(folder, "streams/vreng");
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    AnimationClip clip;
    read_text(entry.path().string(), &clip);
    stream::FbaSettings settings;
    settings.rate = rate_of(clip.frames_per_second);
    settings.fap_quant = 0;  // Levels are values: nothing is lost.
    settings.bap_quant_index = 1;
    stream::set_masks(clip.view(0), &settings);
    stream::set_ranges(clip.view(0), &settings);
    const auto bytes = encode_fba(clip, 0, settings);
    std::vector<stream::ModelNode> nodes(1 << 18);
    stream::FbaDecoder decoder(nodes, {});
    decoder.refill(bytes, true);
    stream::FbaPlane plane;
    face::FapFrame face;
    body::BapFrame body;
    for (std::size_t i = 0; i < clip.size(); ++i) {
      ASSERT_TRUE(decoder.next(&plane, &face, &body).ok()) << entry.path() << " " << i;
      for (int bap = 1; bap <= body::kBapCount && !clip.body.empty(); ++bap) {
        const int step = body::bap_info(bap).quantiser_visage;
        EXPECT_NEAR(body.get(bap), clip.body[i].get(bap), (step + 1) / 2) << entry.path() << bap;
      }
      // Ranges end at 1860: turns of the head are larger.
      for (int fap = 3; fap <= face::kFapCount && !clip.face.empty(); ++fap)
        if (!face::is_rotation(face::fap_info(fap))) {
          EXPECT_EQ(face.get(fap), clip.face[i].get(fap)) << entry.path() << " FAP " << fap;
        }
    }
  }
}

TEST(Rate, PlotIsAPicture) {
  AnimationClip clip;
  clip.face = make_talking_track(8.0, 25.0, 1);
  const auto points = measure_rates(clip, 0, point_error);
  ASSERT_GE(points.size(), 3u);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_GT(points[i].kbit_per_s, points[i - 1].kbit_per_s);
    EXPECT_LT(points[i].step_mm, points[i - 1].step_mm);
  }
  const std::string svg = plot_rates(points);
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace caryatid::bake
