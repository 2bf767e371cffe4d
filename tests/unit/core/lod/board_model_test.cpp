#include "core/lod/board_model.h"

#include <gtest/gtest.h>

#include <string_view>

namespace caryatid::lod {
namespace {

TEST(BoardModel, TheFivePromisedBoardsAreThere) {
  for (const std::string_view name : {"pi-zero-2w", "pi3", "pi4", "mali450", "gc7000"})
    EXPECT_NE(find_board({name.data(), name.size()}), nullptr) << name;
  EXPECT_STREQ(boards()[0].name, "pi-zero-2w");
  const std::string_view none = "pi";
  EXPECT_EQ(find_board({none.data(), none.size()}), nullptr);
}

TEST(BoardModel, EveryKindOfWorkCosts) {
  for (const BoardCosts& board : boards()) {
    const float nothing = sum(cpu_terms(board, {})) + sum(gpu_terms(board, {}));
    EXPECT_GT(nothing, 0.0f);
    for (const Work& work :
         {Work{.triangles = 1000}, Work{.target_px = 1e5f}, Work{.shaded_px = 1e5f}})
      EXPECT_GT(sum(gpu_terms(board, work)), sum(gpu_terms(board, {})));
    for (const Work& work : {Work{.vertices_deformed = 1000}, Work{.records = 100}})
      EXPECT_GT(sum(cpu_terms(board, work)), sum(cpu_terms(board, {})));
    EXPECT_LT(board.gpu_shaded_px_ns[0], board.gpu_shaded_px_ns[1]);
    EXPECT_LT(board.gpu_shaded_px_ns[1], board.gpu_shaded_px_ns[2]);
  }
}

TEST(VirtualBoard, FlipsComeAtVblanks) {
  VirtualBoard board(boards()[0], 1);
  FrameSample sample = board.run({});
  EXPECT_EQ(sample.vblanks, 1);
  EXPECT_EQ(sample.time_us, 16666u);
  sample = board.run({.triangles = 200000});  // 26 ms on the GPU.
  EXPECT_EQ(sample.vblanks, 2);
  EXPECT_EQ(sample.time_us, 50000u);
}

TEST(VirtualBoard, AFrameThatIsReadyTooCloseToTheVblankWaitsForTheNext) {
  BoardCosts costs;
  costs.cpu_fixed_us = 1e6f / 60.0f - kFlipLeadUs + 1.0f;
  EXPECT_EQ(VirtualBoard(costs, 1).run({}).vblanks, 2);
  costs.cpu_fixed_us -= 2.0f;
  EXPECT_EQ(VirtualBoard(costs, 1).run({}).vblanks, 1);
}

TEST(VirtualBoard, KeepsToTheTargetAndTheDivisor) {
  VirtualBoard board(boards()[2], 2);
  EXPECT_EQ(board.run({}).vblanks, 2);
  EXPECT_EQ(board.run({}, 3).vblanks, 6);
}

TEST(VirtualBoard, DisturbancesActWhereTheySay) {
  const auto run = [](const Disturbance& d) { return VirtualBoard(boards()[0], 1).run({}, 1, d); };
  const FrameSample calm = run({});
  EXPECT_NEAR(run({.cpu_factor = 2.0f}).cpu_us, 2.0 * calm.cpu_us, 1.0);
  EXPECT_NEAR(run({.gpu_factor = 2.0f}).gpu_us, 2.0 * calm.gpu_us, 1.0);
  EXPECT_NEAR(run({.spike_us = 3000.0f}).cpu_us, calm.cpu_us + 3000.0, 1.0);
  EXPECT_EQ(run({.has_fence = false}).gpu_us, FrameSample::kUnknown);
}

}  // namespace
}  // namespace caryatid::lod
