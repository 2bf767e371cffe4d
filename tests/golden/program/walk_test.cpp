// The recorded visit of a person with legs: she is there while there is a visitor, walks off when
// nobody comes, and walks in again for the next one.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/golden/program/pixels.h"
#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

// How much the brightest and the darkest pixel of a row differ, at most. The empty stage is a
// gradient from top to bottom.
int spread(const std::filesystem::path& file) {
  const Pixels p = read_png(file);
  int most = 0;
  for (int y = 0; y < p.height; ++y) {
    int low = 255, high = 0;
    for (int x = 0; x < p.width; ++x) {
      low = std::min(low, int{p.rgb[p.at(x, y)]});
      high = std::max(high, int{p.rgb[p.at(x, y)]});
    }
    most = std::max(most, high - low);
  }
  return most;
}

TEST(Walk, SheWalksOffWhenNobodyComesAndInForTheNextVisitor) {
  const std::filesystem::path pack = CARYATID_PACKS "/woman.pack";
  if (!std::filesystem::exists(pack)) GTEST_SKIP() << pack << " is not baked (cross/host.sh does)";
  const auto folder = fresh_folder("walk");
  const auto script =
      write_file(folder / "script", "1.0 joy down\n1.1 joy up\n36.0 calm down\n36.1 calm up\n");
  const Outcome run = run_program(
      "--pack " + pack.string() + " --config " + kSource +
      "/assets/programme/feelings.toml --display surfaceless --size 96x72 --virtual-clock"
      " --target-fps 10 --lod 1500 --audio null --sleep 6 --duration 48 --frames-every 20"
      " --script " +
      script.string() + " --frames-out " + folder.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  constexpr int kSomebody = 60, kNobody = 25;                // The empty stage alone: 12.
  EXPECT_GT(spread(folder / "frame_00160.png"), kSomebody);  // 16 s: visited.
  EXPECT_LT(spread(folder / "frame_00340.png"), kNobody);    // 34 s: long away.
  EXPECT_GT(spread(folder / "frame_00460.png"), kSomebody);  // 46 s: back.
}

}  // namespace
}  // namespace caryatid::golden
