// The program's mouth against its sound on texts that it was not tuned on, and its visemes for
// other players, both by the project's own tool.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

class ToolSpeech : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto bin = std::filesystem::path(CARYATID_PROGRAM).parent_path();
    tool_ = (bin / "caryatid-tool").string();
    if (!std::filesystem::exists(tool_) || !std::filesystem::exists(bin / "caryatid-voice"))
      GTEST_SKIP() << "needs caryatid-tool and caryatid-voice; build all targets";
    folder_ = fresh_folder("tool_speech");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Outcome run_tool(const std::string& arguments) const {
    return run_program("", tool_ + " " + arguments + "; exit $?; ");
  }
  // Per cent of the visemes within -45..15 ms of a held-out text of tests/data/speech.
  double in_step(const std::string& name, const std::string& language) const {
    const std::string text = "\"$(cat " + kSource + "/tests/data/speech/" + name + ".txt)\"";
    const std::string wav = (folder_ / "a.wav").string(), metrics = (folder_ / "m.jsonl").string();
    const Outcome spoken =
        run_program("--display none --virtual-clock --duration 260 --language " + language +
                    " --say " + text + " --audio file:" + wav + " --metrics " + metrics);
    EXPECT_EQ(spoken.exit_code, 0) << spoken.output;
    const Outcome sync = run_tool("speech sync --audio " + wav + " --metrics " + metrics +
                                  " --language " + language + " --text " + text);
    EXPECT_EQ(sync.exit_code, 0) << sync.output;
    const std::size_t at = sync.output.find("lags by at most 45: ");
    const std::size_t drift = sync.output.find("drift: ");
    if (at == std::string::npos || drift == std::string::npos) return -1.0;
    EXPECT_LT(std::abs(std::atof(sync.output.c_str() + drift + 7)), 2.0) << sync.output;
    return std::atof(sync.output.c_str() + at + 20);
  }

  std::string tool_;
  std::filesystem::path folder_;
};

TEST_F(ToolSpeech, HeldOutEnglishIsInStep) { EXPECT_GE(in_step("held_out_en_2", "en"), 99.0); }
TEST_F(ToolSpeech, HeldOutGreekIsInStep) { EXPECT_GE(in_step("held_out_el_1", "el"), 99.0); }

// A .fap file: a line of masks and a line of values for each frame; FAP 1 has three numbers.
TEST_F(ToolSpeech, ATextBecomesVisemesOfFap1) {
  const std::string fap = (folder_ / "x.fap").string();
  const Outcome made = run_tool("speech visemes 'Five maps.' -o " + fap);
  ASSERT_EQ(made.exit_code, 0) << made.output;
  std::istringstream lines(content(fap));
  std::string line;
  std::getline(lines, line);  // Version, name, frames a second, count.
  EXPECT_NE(line.find("25"), std::string::npos) << line;
  std::array<int, 15> seen{};
  int frames = 0;
  std::string order;
  while (std::getline(lines, line)) {
    std::string mask = line;
    mask.erase(std::remove(mask.begin(), mask.end(), ' '), mask.end());
    if (mask.size() < 68) continue;
    EXPECT_EQ(mask[0], '1');
    EXPECT_EQ(std::count(mask.begin(), mask.end(), '1'), 1) << "FAP 1 alone";
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream values(line);
    int number = -1, first = -1, second = -1, blend = -1;
    values >> number >> first >> second >> blend;
    EXPECT_EQ(number, frames);
    ASSERT_TRUE(first >= 0 && first < 15 && second >= 0 && second < 15 && blend >= 0 && blend < 64)
        << line;
    const int shown = blend >= 32 ? first : second;
    ++seen[static_cast<std::size_t>(shown)];
    ++frames;
  }
  EXPECT_GT(frames, 15);
  EXPECT_GE(seen[1], 2) << "m, p";
  EXPECT_GE(seen[2], 2) << "f, v";
  EXPECT_GE(seen[7], 1) << "s";
  EXPECT_GE(seen[10] + seen[11], 2) << "a";
  // And it goes into a stream.
  const Outcome encoded = run_tool("fba encode " + fap + " -o " + (folder_ / "x.fba").string());
  EXPECT_EQ(encoded.exit_code, 0) << encoded.output;
}

}  // namespace
}  // namespace caryatid::golden
