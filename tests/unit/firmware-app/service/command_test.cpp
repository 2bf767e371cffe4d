#include "firmware-app/command.h"

#include <gtest/gtest.h>

namespace caryatid::app {
namespace {

TEST(Command, VerbsTakeTheRestAsText) {
  const Command press = parse_command("  press \t joy  ");
  EXPECT_EQ(press.kind, CommandKind::press);
  EXPECT_EQ(press.text, "joy");
  const Command say = parse_command("say Welcome! Press five for maps.");
  EXPECT_EQ(say.kind, CommandKind::say);
  EXPECT_EQ(say.text, "Welcome! Press five for maps.");
}

TEST(Command, FeelHasAnEmotionAndAStrength) {
  const Command full = parse_command("feel surprise");
  EXPECT_EQ(full.kind, CommandKind::feel);
  EXPECT_EQ(full.emotion, emotion::Emotion::surprise);
  EXPECT_EQ(full.strength, 1.0f);
  EXPECT_NEAR(parse_command("feel joy 0.75").strength, 0.75f, 1e-6f);
  EXPECT_EQ(parse_command("feel joy 1").strength, 1.0f);
}

TEST(Command, RefusesWhatItDoesNotKnowAndSaysWhatToDo) {
  for (const char* line : {"", "   ", "dance", "press", "say", "feel", "feel hunger", "feel joy 2",
                           "feel joy 1.5", "feel joy nan", "feel joy -1", "feel joy 0.x"}) {
    const Command c = parse_command(line);
    EXPECT_EQ(c.kind, CommandKind::wrong) << line;
    EXPECT_FALSE(c.text.empty()) << line;
  }
}

TEST(Command, PlayWithoutAFileStops) {
  EXPECT_EQ(parse_command("play").kind, CommandKind::play);
  EXPECT_TRUE(parse_command("play").text.empty());
  EXPECT_EQ(parse_command("play a b.fba").text, "a b.fba");
}

}  // namespace
}  // namespace caryatid::app
