// The signboard on the small programme, with a font of ten square letters.
#include "core/agent/signboard.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/core/agent/small_programme.h"

namespace caryatid::agent {
namespace {

using scene::Box;

class SignboardTest : public testing::Test {
 protected:
  void SetUp() override {
    header_.em_px = 30;
    header_.spread_px = 4;
    header_.atlas_width = header_.atlas_height = 256;
    header_.glyph_count = 10;
    header_.box_glyph = 9;
    for (std::uint16_t g = 0; g < 10; ++g) glyphs_.push_back({g, g, 0, 20, 30, 0, 1800, 0});
    font_.header = &header_;
    font_.glyphs = glyphs_;
    board_->start(font_);
    guide_.take(small_.programme());
    expand(small_.programme(), *small_.programme().line(0, 0), {}, said_.get());
  }
  void press(std::uint16_t button) {
    const ButtonEvent event{button, true, 0};
    guide_.step(0.03f, {&event, 1}, {}, false);
  }
  // So many seconds of frames; the last one's overlay.
  scene::Overlay run(float seconds, bool speaking, std::int32_t word_byte = -1) {
    input_.programme = &guide_.programme();
    input_.guidance = &guide_.guidance();
    input_.said = said_.get();
    input_.speaking = speaking;
    input_.word_byte = word_byte;
    scene::Overlay out;
    for (float t = 0.0f; t < seconds; t += 0.03f) {
      (void)board_->stage(input_, 0.03f);
      out = board_->overlay(input_, 0.03f);
    }
    return out;
  }

  pack::FontHeader header_{};
  std::vector<pack::FontGlyph> glyphs_;
  pack::FontView font_;
  SmallProgramme small_;
  Guide guide_;
  std::unique_ptr<Utterable> said_ = std::make_unique<Utterable>();
  std::unique_ptr<Signboard> board_ = std::make_unique<Signboard>();
  SignboardInput input_;
};

TEST_F(SignboardTest, NothingIsShownBeforeAnythingIsSaid) {
  EXPECT_TRUE(run(0.1f, false).quads.empty());
}

TEST_F(SignboardTest, CaptionsComeWithTheVoiceAndStayAWhile) {
  EXPECT_FALSE(run(0.1f, true).quads.empty());
  EXPECT_FALSE(board_->caption().empty());
  EXPECT_FALSE(run(2.0f, false).quads.empty());
  EXPECT_TRUE(run(1.0f, false).quads.empty());
}

// "hi x": the second word is heard; the first is said, nothing is to come.
TEST_F(SignboardTest, TheWordThatIsHeardHasItsOwnInk) {
  const auto inks = [](const scene::Overlay& o) {
    std::vector<scene::Ink> out;
    for (const scene::OverlayQuad& q : o.quads)
      if (out.empty() || !(out.back() == q.ink)) out.push_back(q.ink);
    return out;
  };
  const auto first = inks(run(0.1f, true, 0)), second = inks(run(0.1f, true, 3));
  EXPECT_NE(first, second);
  EXPECT_EQ(first.back().r < 200, true);              // "x" is to come: grey.
  EXPECT_EQ(second.back(), first[first.size() - 2]);  // Now it has the ink that "hi" had.
}

TEST_F(SignboardTest, NothingIsMadeAnewWhileNothingChanges) {
  const std::uint32_t version = run(0.5f, true, 0).version;
  EXPECT_EQ(run(0.5f, true, 0).version, version);
  EXPECT_NE(run(0.1f, true, 3).version, version);
}

TEST_F(SignboardTest, CaptionsCanBeTurnedOffAndContrastIsBlackAndWhite) {
  press(SmallProgramme::kContrast);
  const scene::Overlay o = run(2.0f, true, 9);
  ASSERT_FALSE(o.quads.empty());
  for (const scene::OverlayQuad& q : o.quads) {
    EXPECT_EQ(q.ink.a, 255);
    EXPECT_TRUE(q.ink.b == 0 || q.ink.b == 255);
  }
}

// Neither the card nor the captions lie on a head, wherever it is; the card gives way altogether.
TEST_F(SignboardTest, TheHeadIsNeverCovered) {
  press(SmallProgramme::kGoMaps);
  const PictureSize pictures[] = {{400, 300}};
  input_.pictures = pictures;
  for (float x = 0.0f; x < 640.0f; x += 40.0f)
    for (float y = 0.0f; y < 260.0f; y += 40.0f) {
      input_.head = {x, y, x + 160.0f, y + 210.0f};
      const scene::Overlay o = run(0.7f, true, 0);
      EXPECT_FALSE(board_->card().overlaps(input_.head));
      EXPECT_FALSE(board_->caption().overlaps(input_.head));
      for (const scene::OverlayQuad& q : o.quads)  // Margins of the field aside.
        EXPECT_FALSE(q.at.inset(20.0f).overlaps(input_.head)) << x << ", " << y;
    }
}

// She stands where the card would be: it comes on the other side, and stays there.
TEST_F(SignboardTest, TheCardChangesSidesForHer) {
  press(SmallProgramme::kGoMaps);
  const PictureSize pictures[] = {{400, 300}};
  input_.pictures = pictures;
  input_.head = {560, 100, 700, 300};
  (void)run(0.5f, true, 0);
  EXPECT_TRUE(board_->mirrored());
  EXPECT_LT(board_->card().x1, 480.0f);
  EXPECT_FALSE(board_->card().empty());
  input_.head = {600, 100, 740, 300};
  (void)run(0.5f, true, 0);
  EXPECT_TRUE(board_->mirrored());
}

// The welcome page of this programme has nothing to show: she keeps the whole picture.
TEST_F(SignboardTest, APageWithoutContentTakesNoRoom) {
  press(SmallProgramme::kLarge);
  (void)run(0.5f, false);
  EXPECT_TRUE(board_->card().empty());
  EXPECT_EQ(board_->stage(input_, 0.03f), (Box{0, 0, 800, 480}));
}

TEST_F(SignboardTest, ThePictureKeepsItsProportions) {
  press(SmallProgramme::kGoMaps);
  const PictureSize pictures[] = {{400, 100}};
  input_.pictures = pictures;
  const scene::Overlay o = run(1.0f, true, 0);
  EXPECT_EQ(o.picture, 0);
  int seen = 0;
  for (const scene::OverlayQuad& q : o.quads)
    if (q.is_picture != 0) {
      ++seen;
      EXPECT_NEAR(q.at.width() / q.at.height(), 4.0f, 0.01f);
    }
  EXPECT_EQ(seen, 1);
  EXPECT_EQ(run(0.1f, true, 0).quads.size(), o.quads.size());
}

}  // namespace
}  // namespace caryatid::agent
