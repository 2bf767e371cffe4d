// A panel that is mounted turned: the program's picture, turned by --rotate, is the upright one
// turned, pixel for pixel but for how the edges of triangles are sampled.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/golden/program/pixels.h"
#include "tests/golden/program/program.h"

namespace caryatid::golden {
namespace {

Pixels frame(const std::string& size, const std::string& degrees) {
  const auto folder = fresh_folder("rotate_" + degrees);
  const Outcome run = run_program(
      "--pack " + kBuiltin + " --display surfaceless --size " + size + " --rotate " + degrees +
      " --lod 100000 --virtual-clock --duration 0.01 --frames-out " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return read_png(folder / "frame_00000.png");
}

// A quarter turn clockwise.
Pixels quarter(const Pixels& p) {
  Pixels out{p.height, p.width, std::vector<unsigned char>(p.rgb.size())};
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      for (int c = 0; c < 3; ++c)
        out.rgb[out.at(p.height - 1 - y, x) + static_cast<std::size_t>(c)] =
            p.rgb[p.at(x, y) + static_cast<std::size_t>(c)];
  return out;
}

double mean_difference(const Pixels& a, const Pixels& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.empty()) return 255.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

TEST(Rotate, TurnsThePictureClockwise) {
  const Pixels upright = frame("240x160", "0");
  EXPECT_LT(mean_difference(frame("240x160", "180"), quarter(quarter(upright))), 1.5);
  // The same visitor's view on a panel that stands on its side.
  const Pixels tall = frame("160x240", "0");
  EXPECT_LT(mean_difference(frame("240x160", "90"), quarter(tall)), 1.5);
  EXPECT_LT(mean_difference(frame("240x160", "270"), quarter(quarter(quarter(tall)))), 1.5);
  // And the measure can tell: an unturned picture is far off.
  EXPECT_GT(mean_difference(frame("240x160", "180"), upright), 4.0);
}

}  // namespace
}  // namespace caryatid::golden
