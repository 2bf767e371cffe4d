#include <gtest/gtest.h>

#include <cstdio>

#include "tests/board_sim/simulation.h"

namespace caryatid::sim {
namespace {

TEST(Tmp, Table) {
  const char* h = getenv("HOURS");
  for (const auto& board : lod::boards())
    for (std::uint16_t v : {std::uint16_t{2}, std::uint16_t{1}})
      for (int mode = 0; mode < 4; ++mode) {
        Scenario scenario;
        scenario.board = board;
        scenario.vblanks_per_frame = v;
        scenario.policy = mode < 2    ? Policy::controller
                          : mode == 2 ? Policy::fixed
                                      : Policy::reactive;
        scenario.has_fence = mode != 1;
        scenario.hours = h ? atof(h) : 2;
        const Outcome o = Simulation(scenario).run();
        std::printf(
            "%-11s %d %-10s%s in time %8.4f%% late %6lu worst %3u changes/h %6.1f max/s %u tri "
            "%6.0f scale %.3f ms %5.2f\n",
            board.name, 60 / v, name_of(scenario.policy), scenario.has_fence ? "  " : "nf",
            100 * o.in_time(), o.late, o.worst_late_after_step, (double)o.changes / scenario.hours,
            o.most_changes_in_a_second, o.mean_triangles, o.mean_scale, o.mean_us * 1e-3);
      }
}

}  // namespace
}  // namespace caryatid::sim
