// Broken input: one clear line, the promised exit code, and a face on the screen all the same.
#include <gtest/gtest.h>

#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

void expect_one_line(const Outcome& run, int exit_code, const std::string& words) {
  EXPECT_EQ(run.exit_code, exit_code) << run.output;
  EXPECT_EQ(lines(run.output), 1) << run.output;
  EXPECT_NE(run.output.find("caryatid: "), std::string::npos) << run.output;
  EXPECT_NE(run.output.find(words), std::string::npos) << run.output;
}

TEST(Messages, WrongUsageIsExitTwo) {
  expect_one_line(run_program("--no-such-thing"), 2, "no such option");
  expect_one_line(run_program("--size 3x"), 2, "--size 3x");
  expect_one_line(run_program("--pack"), 2, "a value is missing");
  expect_one_line(run_program("kiosk.toml"), 2, "not an option");
  expect_one_line(run_program("--target-fps 0"), 2, "1 to 120");
}

TEST(Messages, HelpIsWhole) {
  const Outcome run = run_program("--help");
  EXPECT_EQ(run.exit_code, 0);
  for (const char* option :
       {"--config",     "--pack",         "--display",           "--size",     "--rotate",
        "--target-fps", "--script",       "--virtual-clock",     "--board",    "--duration",
        "--frames-out", "--frames-every", "--metrics",           "--play",     "--lod",
        "--check",      "--now",          "--compile-programme", "--control",  "--status",
        "--prometheus", "--state",        "--list-hardware",     "--language", "--audio",
        "--sleep",      "examples:"})
    EXPECT_NE(run.output.find(option), std::string::npos) << option;
}

TEST(Messages, CheckNamesWhatIsWrongWithAPack) {
  const auto folder = fresh_folder("packs");
  const std::string whole = content(kBuiltin);
  const Outcome sound = run_program("--check --pack " + kBuiltin);
  EXPECT_EQ(sound.exit_code, 0);
  EXPECT_NE(sound.output.find("sound"), std::string::npos);
  EXPECT_NE(sound.output.find("bytes of the arena"), std::string::npos);
  const auto cut = write_file(folder / "cut.pack", whole.substr(0, whole.size() / 2));
  expect_one_line(run_program("--check --pack " + cut.string()), 1, "cut short");
  std::string flipped = whole;
  flipped[whole.size() - 1000] = static_cast<char>(flipped[whole.size() - 1000] ^ 4);
  const auto flip = write_file(folder / "flip.pack", flipped);
  expect_one_line(run_program("--check --pack " + flip.string()), 1, "damaged");
  const auto text = write_file(folder / "text.pack", std::string(200, 'x'));
  expect_one_line(run_program("--check --pack " + text.string()), 1, "not a Caryatid pack");
  expect_one_line(run_program("--check --pack " + (folder / "none.pack").string()), 1, "none.pack");
}

TEST(Messages, AWrongConfigurationIsReplacedByTheOneThatWorkedLast) {
  const auto folder = fresh_folder("last_good");
  const auto state = fresh_folder("last_good_state");
  const std::string good = "[[button]]\nname = \"a\"\nfeel = \"joy\"\n";
  const auto config = write_file(folder / "kiosk.toml", good);
  const std::string command = "--display none --audio null --duration 0.1 --config " +
                              config.string() + " --state " + state.string() + " --status " +
                              (state / "status").string();
  EXPECT_EQ(run_program(command).exit_code, 0);
  write_file(config, "[[button]\n");
  const Outcome run = run_program(command);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.output.find("kiosk.toml:1: "), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("worked last stands in"), std::string::npos) << run.output;
  EXPECT_NE(content(state / "status").find("\"config_refused\":true"), std::string::npos);
  EXPECT_EQ(content(state / "last_good" / "kiosk.toml"), good);
}

TEST(Messages, ADamagedPackLeavesTheBuiltInFace) {
  const auto folder = fresh_folder("builtin");
  const auto cut = write_file(folder / "cut.pack", content(kBuiltin).substr(0, 5000));
  const Outcome run = run_program(
      "--pack " + cut.string() +
      " --display surfaceless --virtual-clock --duration 0.2 --frames-out " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("built-in face stands in"), std::string::npos) << run.output;
  EXPECT_GT(content(folder / "frame_00003.png").size(), 20000u);
}

TEST(Messages, ConfigErrorsNameTheLine) {
  const auto folder = fresh_folder("config");
  const auto bad =
      write_file(folder / "kiosk.toml", "[[button]]\nname = \"a\"\nfeel = \"bliss\"\n");
  const Outcome run = run_program("--check --config " + bad.string());
  expect_one_line(run, 1, "kiosk.toml:");
  EXPECT_NE(run.output.find("bliss"), std::string::npos);
  const auto broken = write_file(folder / "broken.toml", "[[button]\n");
  expect_one_line(run_program("--check --config " + broken.string()), 1, "broken.toml:1");
}

TEST(Messages, ACheckTellsAllFaultsAtOnce) {
  const auto folder = fresh_folder("check");
  const auto text = write_file(folder / "text.pack", "no pack");
  const Outcome run =
      run_program("--check --config none.toml --script none.script --play none.fap" +
                  std::string(" --voice /none --pack ") + text.string());
  EXPECT_EQ(run.exit_code, 1);
  for (const char* each : {"none.toml", "none.script", "none.fap", "--voice /none", "text.pack"})
    EXPECT_NE(run.output.find(each), std::string::npos) << each << " in " << run.output;
}

TEST(Messages, WhatTheVirtualClockLeavesUndoneIsRefused) {
  for (const char* each : {"control", "status", "prometheus", "state"})
    expect_one_line(run_program(std::string("--virtual-clock --") + each + " x"), 2, each);
}

TEST(Messages, ScriptErrorsNameTheLine) {
  const auto folder = fresh_folder("script");
  const auto unknown = write_file(folder / "a", "# fine\n1.0 bliss down\n");
  expect_one_line(
      run_program("--display none --virtual-clock --duration 1 --script " + unknown.string()), 1,
      ":2: ");
  const auto backwards = write_file(folder / "b", "2 joy down\n1 joy up\n");
  expect_one_line(
      run_program("--display none --virtual-clock --duration 1 --script " + backwards.string()), 1,
      "earlier");
}

}  // namespace
}  // namespace caryatid::golden
