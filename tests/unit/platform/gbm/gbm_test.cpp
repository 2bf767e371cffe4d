#include <gtest/gtest.h>

#include <array>

#include "platform/display/egl_context.h"
#include "platform/display/gbm/card.h"
#include "platform/display/gbm/scanout.h"
#include "platform/display/gbm/watch.h"
#include "tests/unit/platform/gbm/fake_drm.h"

namespace caryatid::platform {
// The real one stands beside EGL, which these tests do without.
void set_error(ErrorLine& out, const char* text) { out.assign({text, std::strlen(text)}); }

namespace gbm {
namespace {

using testing::drm;
using testing::FakeCard;
using testing::mode;
using testing::Shown;

class GbmTest : public ::testing::Test {
 protected:
  void TearDown() override { drm.clear(); }

  // One screen on one CRTC, as a Raspberry Pi has it.
  FakeCard& board(bool connected = true) {
    FakeCard& card = drm.add("card");
    card.crtcs = {40, 41};
    card.encoders = {{30, 0, 0b10}};  // Can drive the second CRTC alone.
    card.planes = {{50, 0b01}, {51, 0b10, DRM_PLANE_TYPE_OVERLAY}, {52, 0b10}};
    card.connectors = {{20, connected, connected, {mode(800, 480, 60, true)}, 0}};
    return card;
  }

  void open(FakeCard&) {
    ASSERT_TRUE(card_.open(error_).ok()) << error_.c_str();
    ASSERT_TRUE(find_output(card_.fd(), card_.atomic(), {}, output_).ok());
    scanout_.attach(card_.fd(), card_.atomic(), output_);
  }

  ErrorLine error_;
  Card card_;
  Output output_;
  Scanout scanout_;
};

std::uint16_t detail(DisplayFault fault) { return static_cast<std::uint16_t>(fault); }

TEST(GbmMode, ThePreferredModeIsTakenUnlessASizeIsInsistedOn) {
  const std::array modes{mode(1920, 1080, 60), mode(1280, 720, 60, true), mode(800, 480, 60)};
  EXPECT_EQ(choose_mode(modes, {800, 480, false}), 1u);
  EXPECT_EQ(choose_mode(modes, {800, 480, true}), 2u);
}

TEST(GbmMode, AnUnknownSizeFallsBackToThePreferredThenToTheLargestThatFitsThenToTheFirst) {
  const std::array preferred{mode(1920, 1080, 60), mode(1280, 720, 60, true)};
  EXPECT_EQ(choose_mode(preferred, {1000, 700, true}), 1u);
  const std::array none{mode(1920, 1080, 60), mode(640, 480, 60), mode(800, 600, 60)};
  EXPECT_EQ(choose_mode(none, {1000, 700, true}), 2u);
  EXPECT_EQ(choose_mode(none, {320, 200, true}), 0u);
}

TEST(GbmMode, AmongEqualSizesTheRateNearestTo60IsTakenAndInterlaceIsAvoided) {
  const std::array modes{mode(800, 480, 30), mode(800, 480, 60, false, true), mode(800, 480, 75),
                         mode(800, 480, 144)};
  EXPECT_EQ(choose_mode(modes, {800, 480, true}), 2u);
}

TEST(GbmMode, ThePeriodComesFromThePixelClock) {
  EXPECT_NEAR(static_cast<double>(period_us(mode(800, 480, 60))), 16667.0, 20.0);
  EXPECT_NEAR(static_cast<double>(period_us(mode(800, 480, 50))), 20000.0, 20.0);
  EXPECT_EQ(period_us(drmModeModeInfo{}), 16667);
}

TEST_F(GbmTest, TheCardWithAConnectedScreenIsTaken) {
  drm.add("renders-only");
  FakeCard& dark = board(false);
  FakeCard& lit = board(true);
  ASSERT_TRUE(card_.open(error_).ok());
  EXPECT_EQ(&drm.at(card_.fd()), &lit);
  dark.connectors[0].connected = true;
  lit.connectors[0].connected = false;
  ASSERT_TRUE(card_.open(error_).ok());
  EXPECT_EQ(&drm.at(card_.fd()), &dark);
}

TEST_F(GbmTest, ACardThatOnlyRendersIsNone) {
  drm.add("renders-only");
  const Status status = card_.open(error_);
  EXPECT_EQ(status.code, Code::io);
  EXPECT_EQ(status.detail, detail(DisplayFault::no_card));
  EXPECT_GT(error_.size(), 0u);
}

TEST_F(GbmTest, TheCrtcIsOneThatTheEncoderCanDriveAndThePlaneItsPrimary) {
  open(board());
  EXPECT_EQ(output_.crtc, 41u);
  EXPECT_EQ(output_.plane, 52u);
  EXPECT_STREQ(output_.name.c_str(), "HDMI-A-20");
}

TEST_F(GbmTest, TheCrtcOfTheSplashScreenIsKept) {
  FakeCard& card = board();
  card.encoders = {{30, 41, 0b11}};
  card.connectors[0].encoder = 30;
  open(card);
  EXPECT_EQ(output_.crtc, 41u);
}

TEST_F(GbmTest, OnlyLayoutsOfOurFormatAreOffered) {
  FakeCard& card = board();
  card.modifiers = true;
  card.linear_modifiers = {7, 8, 9};
  open(card);
  ASSERT_EQ(output_.modifiers.size(), 2u);
  EXPECT_EQ(output_.modifiers[0], 7u);
  EXPECT_EQ(output_.modifiers[1], 9u);
}

TEST_F(GbmTest, NoScreenIsNotReady) {
  FakeCard& card = board(false);
  ASSERT_TRUE(card_.open(error_).ok());
  EXPECT_EQ(find_output(card_.fd(), true, {}, output_).code, Code::not_ready);
  card.connectors[0].connected = true;
  EXPECT_TRUE(find_output(card_.fd(), true, {}, output_).ok());
}

TEST_F(GbmTest, APulledCableIsSeenWithoutAProbe) {
  FakeCard& card = board();
  open(card);
  EXPECT_TRUE(still_connected(card_.fd(), output_.connector));
  card.connectors[0].known_connected = false;
  EXPECT_FALSE(still_connected(card_.fd(), output_.connector));
}

TEST_F(GbmTest, TheFirstPictureSetsTheModeAndTheOthersFlip) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  ASSERT_TRUE(scanout_.show(2).ok());
  ASSERT_EQ(card.shown.size(), 3u);
  EXPECT_EQ(card.shown[0].by, Shown::By::mode_set);
  EXPECT_EQ(card.shown[0].mode, "800x480@60");
  EXPECT_EQ(card.shown[1].by, Shown::By::flip);
  EXPECT_EQ(card.shown[2].fb, 2u);
  EXPECT_TRUE(card.shown[2].atomic);
}

TEST_F(GbmTest, WithoutAtomicCommitsTheOlderCallsAreUsed) {
  FakeCard& card = board();
  card.atomic = false;
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  ASSERT_EQ(card.shown.size(), 2u);
  EXPECT_EQ(card.shown[0].by, Shown::By::mode_set);
  EXPECT_FALSE(card.shown[0].atomic);
  EXPECT_FALSE(card.shown[1].atomic);
}

TEST_F(GbmTest, TheDeployerMayRefuseAtomicCommits) {
  board();
  ASSERT_TRUE(card_.open(error_, true).ok());
  EXPECT_FALSE(card_.atomic());
  EXPECT_FALSE(card_.modifiers());
  ASSERT_TRUE(card_.open(error_).ok());
  EXPECT_TRUE(card_.atomic());
}

TEST_F(GbmTest, FlipsAreStampedByTheScreen) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  EXPECT_EQ(scanout_.last_flip().count, 1u);
  EXPECT_EQ(scanout_.last_flip().time_us, card.clock_us);
  card.flip_takes_us = 2 * 16667;
  ASSERT_TRUE(scanout_.show(2).ok());
  EXPECT_EQ(scanout_.last_flip().vblanks, 2u);
  EXPECT_EQ(scanout_.last_flip().time_us, card.clock_us);
}

TEST_F(GbmTest, WithoutACounterTheTimeTellsThePeriods) {
  FakeCard& card = board();
  card.counts_vblanks = false;
  card.flip_takes_us = 3 * 16667 + 900;
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  ASSERT_TRUE(scanout_.show(2).ok());
  EXPECT_EQ(scanout_.last_flip().vblanks, 3u);
}

TEST_F(GbmTest, ALostFlipIsAskedForAgain) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  card.events_to_lose = 1;
  EXPECT_TRUE(scanout_.show(2).ok());
  EXPECT_EQ(scanout_.lost_flips(), 1u);
  EXPECT_EQ(card.shown.back().fb, 2u);
}

// The time of the GPU's fence is that of the look that finds it signalled.
TEST_F(GbmTest, WhileAFlipIsWaitedForSomeoneLooksUntilThereIsNothingMoreToSee) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  card.events_to_lose = 1;  // A long wait.
  int looks = 0;
  const auto look = [](void* n) { return ++*static_cast<int*>(n) >= 3; };
  EXPECT_TRUE(scanout_.show(2, {look, &looks, 250}).ok());
  EXPECT_GE(looks, 2);
  EXPECT_LE(looks, 4);  // And once more when the flip is asked for again.
}

TEST_F(GbmTest, ADriverThatLosesFlipAfterFlipIsGivenUp) {
  FakeCard& card = board();
  open(card);
  card.events_to_lose = 100;
  const Status status = scanout_.show(1);
  EXPECT_EQ(status.code, Code::device_lost);
  EXPECT_EQ(status.detail, detail(DisplayFault::flip_lost));
  EXPECT_EQ(scanout_.lost_flips(), 3u);
}

TEST_F(GbmTest, ALostMasterIsNoEndAndTheModeIsSetAnewAfterIt) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  card.master_taken = true;
  const Status status = scanout_.show(2);
  EXPECT_EQ(status.code, Code::not_ready);
  EXPECT_EQ(status.detail, detail(DisplayFault::not_master));
  EXPECT_FALSE(card_.take_master());
  card.master_taken = false;
  EXPECT_TRUE(card_.take_master());
  card.shown.clear();
  ASSERT_TRUE(scanout_.show(2).ok());
  EXPECT_EQ(card.shown[0].by, Shown::By::mode_set);
}

TEST_F(GbmTest, ARefusedModeIsAScreenToLookForAgain) {
  FakeCard& card = board();
  open(card);
  card.mode_errno = EINVAL;
  EXPECT_EQ(scanout_.show(1).code, Code::not_ready);
  card.mode_errno = 0;
  EXPECT_TRUE(scanout_.show(1).ok());
}

TEST_F(GbmTest, ARemovedCardIsLost) {
  FakeCard& card = board();
  open(card);
  card.flip_errno = ENODEV;
  const Status status = scanout_.show(1);
  EXPECT_EQ(status.code, Code::device_lost);
  EXPECT_EQ(status.detail, detail(DisplayFault::no_card));
}

TEST_F(GbmTest, ABusyFlipWaitsForTheOneOnItsWay) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  card.flip_errno = EBUSY;
  EXPECT_EQ(scanout_.show(2).code, Code::device_lost);  // It never comes.
  EXPECT_EQ(scanout_.lost_flips(), 3u);
}

TEST_F(GbmTest, DarkAndLitAgainSetsTheMode) {
  FakeCard& card = board();
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  scanout_.darken();
  EXPECT_EQ(card.shown.back().by, Shown::By::dark);
  card.shown.clear();
  ASSERT_TRUE(scanout_.show(2).ok());
  EXPECT_EQ(card.shown[0].by, Shown::By::mode_set);
}

TEST_F(GbmTest, TheScreenIsLeftAsItWasFound) {
  FakeCard& card = board();
  card.splash_fb = 77;
  open(card);
  ASSERT_TRUE(scanout_.show(1).ok());
  scanout_.restore();
  EXPECT_EQ(card.shown.back().by, Shown::By::mode_set);
  EXPECT_EQ(card.shown.back().fb, 77u);
  EXPECT_EQ(card.shown.back().mode, "splash");
}

TEST(ScreenWatch, LooksOnceASecondAndTellsAChangeOnce) {
  using Action = ScreenWatch::Action;
  ScreenWatch watch;
  EXPECT_EQ(watch.due(1'000'000), Action::probe);
  EXPECT_EQ(watch.due(1'500'000), Action::nothing);
  EXPECT_TRUE(watch.missing());
  EXPECT_EQ(watch.due(2'000'000), Action::probe);
  EXPECT_FALSE(watch.missing());
  EXPECT_TRUE(watch.found());
  EXPECT_EQ(watch.due(3'000'000), Action::look);
  watch.doubt();
  EXPECT_FALSE(watch.in_use());
  EXPECT_EQ(watch.due(4'000'000), Action::probe);
  EXPECT_FALSE(watch.found());  // It was there all the time as far as anyone was told.
}

}  // namespace
}  // namespace gbm
}  // namespace caryatid::platform
