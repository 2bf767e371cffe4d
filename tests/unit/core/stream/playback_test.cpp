#include "core/stream/playback.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/stream/fba_encoder.h"
#include "core/stream/fba_plan.h"

namespace caryatid::stream {
namespace {

// Jaw opening by 4 units a frame, at 10 frames a second.
std::vector<std::byte> jaw_stream(std::size_t frames) {
  std::vector<face::FapFrame> clip(frames);
  for (std::size_t i = 0; i < frames; ++i) clip[i].set(3, 4.0f * static_cast<float>(i));
  FbaSettings settings;
  settings.rate = {10, 0, false};
  settings.fap_mask.set(3);
  std::vector<ModelNode> nodes(256);
  FbaEncoder encoder(settings, nodes);
  std::vector<std::byte> bytes(1 << 16);
  BitWriter writer(bytes);
  EXPECT_TRUE(encoder.begin(&writer).ok());
  for (std::size_t i = 0; i < frames; ++i) {
    FbaPlaneInput plane;
    plane.face = &clip[i];
    plane.intra = i % 10 == 0;
    EXPECT_TRUE(encoder.encode(plane, &writer).ok());
  }
  EXPECT_TRUE(encoder.finish(&writer).ok());
  bytes.resize(writer.size_bytes());
  return bytes;
}

struct Bench {
  std::vector<std::byte> buffer = std::vector<std::byte>(FbaPlayback::kMinBufferBytes);
  std::vector<ModelNode> nodes = std::vector<ModelNode>(1024);
  FbaPlayback playback{buffer, nodes, {}};
};

TEST(Playback, CompletesFramesByTheRulesOfTheFace) {
  face::FitRule rule{};
  rule.receiver = 14;
  rule.numerator_count = 1;
  rule.numerator[0] = {-2.0f, {3, 0}, {1, 0}};
  const auto bytes = jaw_stream(3);
  Bench bench;
  bench.playback.set_fit({&rule, 1});
  bench.playback.push(bytes);
  bench.playback.close();
  EXPECT_TRUE(bench.playback.advance(0.0));
  EXPECT_TRUE(bench.playback.advance(0.11));
  EXPECT_EQ(bench.playback.face().get(3), 4.0f);
  EXPECT_EQ(bench.playback.face().get(14), -8.0f);
}

TEST(Playback, ShowsTheFrameThatIsDue) {
  const auto bytes = jaw_stream(30);
  Bench bench;
  bench.playback.push(bytes);
  bench.playback.close();
  EXPECT_TRUE(bench.playback.advance(0.0));
  for (int tenth = 1; tenth < 30; ++tenth) {
    EXPECT_TRUE(bench.playback.advance(0.1 * tenth + 0.01));
    EXPECT_EQ(bench.playback.face().get(3), 4.0f * static_cast<float>(tenth));
    EXPECT_FALSE(bench.playback.advance(0.1 * tenth + 0.05));
  }
  bench.playback.advance(4.0);
  EXPECT_TRUE(bench.playback.ended());
  EXPECT_TRUE(bench.playback.last_fault().ok());
}

TEST(Playback, HoldsTheFaceWhileBytesAreLate) {
  const auto bytes = jaw_stream(30);
  Bench bench;
  bench.playback.push(std::span(bytes).first(bytes.size() / 2));
  bench.playback.advance(0.0);
  bench.playback.advance(100.0);
  const float held = bench.playback.face().get(3);
  EXPECT_GT(held, 0.0f);
  EXPECT_FALSE(bench.playback.advance(200.0));
  EXPECT_EQ(bench.playback.face().get(3), held);
  EXPECT_FALSE(bench.playback.ended());
  bench.playback.push(std::span(bytes).subspan(bytes.size() / 2));
  bench.playback.close();
  // No race after what was missed: it goes on from here.
  bench.playback.advance(300.0);
  EXPECT_LT(bench.playback.face().get(3), 116.0f);
  bench.playback.advance(303.0);
  EXPECT_EQ(bench.playback.face().get(3), 116.0f);
  EXPECT_TRUE(bench.playback.ended());
}

TEST(Playback, BeginsWhenTheFirstPlaneArrives) {
  const auto bytes = jaw_stream(30);
  Bench bench;
  EXPECT_FALSE(bench.playback.advance(50.0));
  bench.playback.push(bytes);
  bench.playback.close();
  bench.playback.advance(60.0);
  EXPECT_EQ(bench.playback.face().get(3), 0.0f);
  bench.playback.advance(60.51);
  EXPECT_EQ(bench.playback.face().get(3), 20.0f);
  bench.playback.advance(62.95);
  EXPECT_TRUE(bench.playback.ended());
  EXPECT_NEAR(bench.playback.next_due_s(), 63.0, 1e-6);
}

TEST(Playback, TakesNoMoreThanItsBufferHolds) {
  const auto bytes = jaw_stream(300);
  Bench bench;
  std::vector<std::byte> repeated;
  while (repeated.size() < 3 * FbaPlayback::kMinBufferBytes)
    repeated.insert(repeated.end(), bytes.begin(), bytes.end());
  EXPECT_EQ(bench.playback.push(repeated), FbaPlayback::kMinBufferBytes);
  EXPECT_EQ(bench.playback.push(repeated), 0u);
}

TEST(Playback, DamageIsReportedAndHeld) {
  auto bytes = jaw_stream(30);
  for (std::size_t i = 20; i < 24; ++i) bytes[i] = std::byte{0};
  Bench bench;
  bench.playback.push(bytes);
  bench.playback.close();
  bench.playback.advance(0.0);
  bench.playback.advance(100.0);
  EXPECT_EQ(bench.playback.face().get(3), 116.0f);
}

TEST(Playback, FillsPartnersAndKeepsTheRangeOfTheTable) {
  std::vector<face::FapFrame> clip(1);
  clip[0].set(6, 3000.0f);
  FbaSettings settings;
  settings.fap_mask.set(6);
  std::vector<ModelNode> nodes(16);
  FbaEncoder encoder(settings, nodes);
  std::vector<std::byte> bytes(256);
  BitWriter writer(bytes);
  ASSERT_TRUE(encoder.begin(&writer).ok());
  FbaPlaneInput plane;
  plane.face = &clip[0];
  ASSERT_TRUE(encoder.encode(plane, &writer).ok());
  ASSERT_TRUE(encoder.finish(&writer).ok());
  Bench bench;
  bench.playback.push(std::span(bytes).first(writer.size_bytes()));
  bench.playback.close();
  bench.playback.advance(0.0);
  for (const int fap : {6, 7, 53, 54})
    EXPECT_EQ(bench.playback.face().get(fap), face::coding_limit(face::fap_info(6)));
}

}  // namespace
}  // namespace caryatid::stream
