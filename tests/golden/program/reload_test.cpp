// Texts that change while the kiosk runs: taken over, or refused with their line; it never stops.
#include <gtest/gtest.h>

#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

class Reload : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder("reload");
    std::filesystem::copy(kSource + "/assets/programme", folder_,
                          std::filesystem::copy_options::recursive);
  }
  // Runs the kiosk and puts `text` in place of its Greek texts after a second.
  Outcome run_and_change(const std::string& text) {
    const auto changed = write_file(folder_ / "changed", text);
    const std::string file = (folder_ / "texts/el.toml").string();
    const std::string command = "(sleep 1; cp " + changed.string() + " " + file + ") & ";
    const std::string arguments = "--config " + (folder_ / "kiosk.toml").string() +
                                  " --display none --audio null --duration 8";
    const Outcome run = run_program(arguments, command);
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_NE(run.output.find(" 0 allocations after the seal"), std::string::npos) << run.output;
    return run;
  }
  std::string greek() const { return content(folder_ / "texts/el.toml"); }
  std::filesystem::path folder_;
};

TEST_F(Reload, ChangedTextsAreTakenOver) {
  const Outcome run = run_and_change(greek() + "# changed\n");
  EXPECT_NE(run.output.find("changed texts taken over"), std::string::npos) << run.output;
}

TEST_F(Reload, AWrongTextIsRefusedWithItsLineAndTheOldOneGoesOn) {
  const std::string text = greek();
  const std::size_t at = text.find("[welcome]");
  const Outcome run = run_and_change(text.substr(0, at) + "[welcome]\ntitle = oops\n");
  const auto line = std::count(text.begin(), text.begin() + static_cast<long>(at), '\n') + 2;
  EXPECT_NE(run.output.find("el.toml:" + std::to_string(line) + ": "), std::string::npos)
      << run.output;
  EXPECT_NE(run.output.find("the old ones go on"), std::string::npos) << run.output;
}

// Pages, menus and what buttons do change; a button keeps its device by its name, wherever it
// stands in the list; what is new waits for the next start and is named.
TEST_F(Reload, OtherPagesAndButtonsAreTakenOverByName) {
  std::filesystem::create_directories(folder_ / "small/texts");
  const auto config =
      write_file(folder_ / "small/kiosk.toml", "[[button]]\nname = 'a'\n[[button]]\nname = 'b'\n");
  write_file(folder_ / "small/texts/en.toml",
             "[q]\nsay = 'one two three four five six'\n[picture]\nn = 'x'\n");
  const auto changed = write_file(folder_ / "changed",
                                  "[[picture]]\nname = 'n'\nfile = 'new.png'\n"
                                  "[[page]]\nname = 'p'\n[[page]]\nname = 'q'\nshow = 'n'\n"
                                  "[[button]]\nname = 'z'\n"
                                  "[[button]]\nname = 'b'\ngo = 'q'\n");
  const auto script = write_file(folder_ / "script", "8 a down\n8.1 b down\n");
  const auto metrics = folder_ / "m.jsonl";
  const Outcome run =
      run_program("--config " + config.string() + " --script " + script.string() + " --metrics " +
                      metrics.string() + " --display none --audio null --duration 12",
                  "(sleep 1; cp " + changed.string() + " " + config.string() + ") & ");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find(" 0 allocations after the seal"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("changed texts taken over"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("button 'z' is new"), std::string::npos) << run.output;
  EXPECT_EQ(run.output.find("button 'b' is new"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("new.png: is a new picture"), std::string::npos) << run.output;
  EXPECT_NE(content(metrics).find("\"word\":5"), std::string::npos) << "b does not lead to q";
}

TEST(Texts, CheckNamesEveryFaultOfAProgramme) {
  const auto folder = fresh_folder("faults");
  std::filesystem::create_directories(folder / "texts");
  write_file(folder / "kiosk.toml",
             "[[picture]]\nname = 'p'\nfile = 'bomb.png'\n[[page]]\nname = 'a'\nshow = 'p'\n"
             "[[button]]\nname = '1'\ngo = 'nowhere'\n");
  write_file(folder / "texts/en.toml",
             "[a]\nsay = 'so <blink>it</blink> is'\n[picture]\np = 'x'\n");
  std::string bomb("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\1\0\0\x08\2\0\0\0", 29);
  write_file(folder / "bomb.png", bomb + std::string(100, 'x'));
  const std::string config = (folder / "kiosk.toml").string();
  const Outcome check = run_program("--check --config " + config);
  EXPECT_EQ(check.exit_code, 1);
  for (const char* words : {"kiosk.toml:9: there is no page 'nowhere'",
                            "en.toml:2: 'a.say': unknown", "bomb.png: is 65536x65536 pixels"})
    EXPECT_NE(check.output.find(words), std::string::npos) << check.output;
  // The person comes all the same.
  const Outcome run =
      run_program("--config " + config + " --display none --virtual-clock --duration 0.5");
  EXPECT_EQ(run.exit_code, 0) << run.output;
}

TEST(Texts, ABrokenConfigurationLeavesTheBuiltInProgramme) {
  const auto folder = fresh_folder("broken");
  const auto config = write_file(folder / "kiosk.toml", "[[button]\n");
  const Outcome run =
      run_program("--config " + config.string() + " --display none --virtual-clock --duration 0.5");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("kiosk.toml:1: "), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("the built-in programme stands in"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace caryatid::golden
