#include "platform/log/log.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace caryatid::platform {
namespace {

constexpr int kEvents = static_cast<int>(Event::state_refused) + 1;

TEST(Log, EveryEventHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kEvents; ++i) names.insert(event_name(static_cast<Event>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kEvents));
  EXPECT_STREQ(event_name(Event::button_lost), "button-lost");
}

TEST(Log, OutsideSystemdALineGoesToStderr) {
  testing::internal::CaptureStderr();
  log(Event::pack_damaged, "%s: cut at byte %d", "woman.pack", 7);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "caryatid: woman.pack: cut at byte 7\n");
}

TEST(Log, ALineStaysOneLineAndIsCut) {
  testing::internal::CaptureStderr();
  const std::string text = "a\nb" + std::string(5000, 'x');
  log(Event::pack_damaged, "%s", text.c_str());
  const std::string seen = testing::internal::GetCapturedStderr();
  EXPECT_EQ(seen.find('\n'), seen.size() - 1);
  EXPECT_EQ(seen.substr(0, 13), "caryatid: a b");
  EXPECT_LT(seen.size(), 1100u);
}

// https://systemd.io/JOURNAL_NATIVE_PROTOCOL: NAME=value lines.
TEST(Log, TheJournalGetsTheEventAsAField) {
  char out[512];
  const std::size_t n = format_journal(Event::screen_lost, "gone", out, sizeof out);
  EXPECT_EQ(std::string(out, n),
            "MESSAGE=gone\nPRIORITY=4\nSYSLOG_IDENTIFIER=caryatid\nCARYATID_EVENT=screen-lost\n");
  EXPECT_EQ(format_journal(Event::screen_lost, "gone", out, 20), 0u);
}

}  // namespace
}  // namespace caryatid::platform
