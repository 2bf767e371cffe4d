// Same script, same clock: the same pictures and numbers, bit for bit.
#include <gtest/gtest.h>

#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

std::string play(const std::filesystem::path& out, const std::string& more = "") {
  const Outcome run =
      run_program("--pack " + kBuiltin +
                  " --display surfaceless --size 200x160"
                  " --virtual-clock --duration 3 --frames-every 12 --script " +
                  kSource + "/assets/programme/default.script --frames-out " + out.string() +
                  " --metrics " + (out / "metrics.jsonl").string() + " " + more);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return run.output;
}

TEST(Replay, TwoRunsGiveTheSameBits) {
  const auto a = fresh_folder("a"), b = fresh_folder("b");
  play(a);
  play(b);
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(a)) {
    EXPECT_EQ(content(entry.path()), content(b / entry.path().filename())) << entry.path();
    pictures += entry.path().extension() == ".png";
  }
  EXPECT_EQ(pictures, 9);  // Frames 0, 12 .. 84 and the sheet.
}

// By the real clock the controller learns what the GPU takes.
TEST(Replay, LiveTheGpuIsTimed) {
  const auto out = fresh_folder("gpu");
  const Outcome run = run_program("--pack " + kBuiltin +
                                  " --display surfaceless --size 200x160 --duration 0.5"
                                  " --metrics " +
                                  (out / "metrics.jsonl").string());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const std::string metrics = content(out / "metrics.jsonl");
  EXPECT_NE(metrics.find("\"gpu_ms\":"), std::string::npos);
  EXPECT_EQ(metrics.find("\"gpu_ms\":null"), std::string::npos);
}

TEST(Replay, AnotherSeedIsAnotherLife) {
  const auto a = fresh_folder("s1"), b = fresh_folder("s2");
  play(a);
  play(b, "--seed 2");
  EXPECT_NE(content(a / "frame_00084.png"), content(b / "frame_00084.png"));
}

TEST(Replay, NothingIsAllocatedAfterTheSeal) {
  const auto out = fresh_folder("heap");
  EXPECT_NE(play(out).find(" 0 allocations after the seal"), std::string::npos);
  const std::string metrics = content(out / "metrics.jsonl");
  EXPECT_EQ(metrics.find("\"allocations_since_seal\":0,"),
            metrics.find("\"allocations_since_seal\""));
  EXPECT_EQ(std::count(metrics.begin(), metrics.end(), '\n'), 90);
}

// The script presses joy at 1.0 s, frame 30. That very frame differs from the one of a run without.
TEST(Replay, TheFaceReactsInTheFrameOfThePress) {
  const auto with = fresh_folder("press"), without = fresh_folder("calm");
  const auto script = write_file(with / "script", "1.0 joy down\n");
  const auto none = write_file(without / "script", "# nobody\n");
  for (const auto& [folder, file] : {std::pair{with, script}, std::pair{without, none}}) {
    const Outcome run = run_program("--pack " + kBuiltin +
                                    " --display surfaceless --size 200x160"
                                    " --virtual-clock --duration 1.1 --frames-out " +
                                    folder.string() + " --script " + file.string());
    EXPECT_EQ(run.exit_code, 0) << run.output;
  }
  EXPECT_EQ(content(with / "frame_00029.png"), content(without / "frame_00029.png"));
  EXPECT_NE(content(with / "frame_00030.png"), content(without / "frame_00030.png"));
}

}  // namespace
}  // namespace caryatid::golden
