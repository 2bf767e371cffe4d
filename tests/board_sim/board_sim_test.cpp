// Forty minutes on each board with the promises of the day-long run of caryatid-bench.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/board_sim/simulation.h"

namespace caryatid::sim {
namespace {

Scenario scenario_of(const lod::BoardCosts& board, int fps, Policy policy = Policy::controller) {
  Scenario scenario;
  scenario.board = board;
  scenario.vblanks_per_frame = static_cast<std::uint16_t>(60 / fps);
  scenario.policy = policy;
  scenario.hours = 40.0 / 60.0;
  return scenario;
}

TEST(BoardSim, NoiseIsAsStated) {
  Disturbances disturbances(5);
  disturbances.quiet();
  double sum = 0, squares = 0;
  int spikes = 0;
  constexpr int kDraws = 1'000'000;
  for (int n = 0; n < kDraws; ++n) {
    const lod::Disturbance d = disturbances.next(0);
    const double x = std::log(static_cast<double>(d.gpu_factor));
    sum += x;
    squares += x * x;
    spikes += d.spike_us > 0.0f;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 2e-4);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 0.04, 2e-4);
  EXPECT_NEAR(spikes, 200, 50);
}

TEST(BoardSim, StepsHappen) {
  Scenario scenario = scenario_of(lod::boards()[0], 30);
  scenario.hours = 2;
  const Outcome outcome = Simulation(scenario).run();
  EXPECT_GT(outcome.steps, 20u);
  EXPECT_LT(outcome.steps, 80u);
}

TEST(BoardSim, FramesAreInTimeOnEveryBoard) {
  for (const lod::BoardCosts& board : lod::boards())
    for (const int fps : {30, 60}) {
      SCOPED_TRACE(std::string(board.name) + " at " + std::to_string(fps));
      const Outcome o = Simulation(scenario_of(board, fps)).run();
      EXPECT_GE(o.in_time(), 0.999);
      EXPECT_LE(o.worst_late_after_step, 3u);
      EXPECT_LE(o.most_changes_in_a_second, 1u);
    }
}

TEST(BoardSim, WithoutFencesFramesAreStillInTime) {
  for (const lod::BoardCosts& board : lod::boards()) {
    SCOPED_TRACE(board.name);
    Scenario scenario = scenario_of(board, 60);
    scenario.has_fence = false;
    const Outcome o = Simulation(scenario).run();
    EXPECT_GE(o.in_time(), 0.999);
    EXPECT_LE(o.worst_late_after_step, 3u);
    EXPECT_LE(o.most_changes_in_a_second, 1u);
  }
}

// The disturbances are worth simulating: without the controller frames are late.
TEST(BoardSim, AFixedLevelAndANaiveControllerAreLate) {
  for (const Policy policy : {Policy::fixed, Policy::reactive}) {
    Scenario scenario = scenario_of(lod::boards()[0], 60, policy);
    scenario.hours = 3;
    EXPECT_LT(Simulation(scenario).run().in_time(), 0.999) << name_of(policy);
  }
}

TEST(BoardSim, SameSeedSameDay) {
  const Scenario scenario = scenario_of(lod::boards()[1], 60);
  EXPECT_EQ(Simulation(scenario).run().hash, Simulation(scenario).run().hash);
}

// On a board with time to spare the controller must not pay for safety with coarse meshes.
TEST(BoardSim, SpareTimeIsSpent) {
  const Outcome o = Simulation(scenario_of(lod::boards()[2], 30)).run();
  EXPECT_GT(o.mean_triangles, 0.9 * 46008);
  EXPECT_GT(o.mean_scale, 0.99);
}

}  // namespace
}  // namespace caryatid::sim
