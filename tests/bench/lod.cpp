// The budget controller: what a step costs, and a day on each simulated board beside a fixed level
// and a naive reactive controller.
#include <vector>

#include "core/base/crc.h"
#include "tests/bench/bench.h"
#include "tests/board_sim/simulation.h"

namespace caryatid::bench {
namespace {

struct Row {
  sim::Scenario scenario;
  sim::Outcome outcome;
};
std::vector<Row>& rows() {
  static std::vector<Row> list;
  return list;
}

void print_table() {
  if (rows().empty()) return;
  std::printf(
      "\n%.0f h of virtual time a line; noise 4 %%, 3 ms spikes, throttling, load steps, shots\n"
      "%-11s %3s %4s %-22s %9s %8s %6s %10s %9s %9s %6s\n",
      rows()[0].scenario.hours, "board", "fps", "seed", "policy", "in time", "late", "worst*",
      "changes/h", "most/s**", "triangles", "scale");
  for (const Row& row : rows()) {
    const sim::Outcome& o = row.outcome;
    const std::string policy = std::string(sim::name_of(row.scenario.policy)) +
                               (row.scenario.has_fence ? "" : ", no fence");
    std::printf("%-11s %3d %4u %-22s %8.4f%% %8llu %6u %10.1f %9u %9.0f %6.3f\n",
                row.scenario.board.name, 60 / row.scenario.vblanks_per_frame,
                static_cast<unsigned>(row.scenario.seed), policy.c_str(), 100.0 * o.in_time(),
                static_cast<unsigned long long>(o.late), o.worst_late_after_step,
                static_cast<double>(o.changes) / row.scenario.hours, o.most_changes_in_a_second,
                o.mean_triangles, o.mean_scale);
  }
  std::puts("*  most late frames within 2 s after a load or thermal step");
  std::puts("** most level changes within a second of steady state");
}

void day(benchmark::State& state, const sim::Scenario& scenario) {
  sim::Outcome outcome;
  for ([[maybe_unused]] auto _ : state) outcome = sim::Simulation(scenario).run();
  state.counters["frames"] = static_cast<double>(outcome.frames);
  state.counters["late"] = static_cast<double>(outcome.late);
  state.counters["in_time_percent"] = 100.0 * outcome.in_time();
  state.counters["worst_late_after_step"] = outcome.worst_late_after_step;
  state.counters["changes"] = static_cast<double>(outcome.changes);
  state.counters["most_changes_per_s"] = outcome.most_changes_in_a_second;
  state.SetLabel(label_of(outcome.hash));
  rows().push_back({scenario, outcome});
}

void register_day(const lod::BoardCosts& board, int fps, const std::string& policy,
                  std::uint64_t seed) {
  sim::Scenario scenario;
  scenario.board = board;
  scenario.vblanks_per_frame = static_cast<std::uint16_t>(60 / fps);
  scenario.policy = policy[0] == 'c'   ? sim::Policy::controller
                    : policy[0] == 'f' ? sim::Policy::fixed
                                       : sim::Policy::reactive;
  scenario.has_fence = policy != "controller_no_fence";
  scenario.seed = seed;
  const std::string name = std::string("lod/day/") + board.name + "/" + std::to_string(fps) + "/" +
                           policy + "/" + std::to_string(seed);
  benchmark::RegisterBenchmark(name.c_str(), day, scenario)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

bool register_days() {
  for (const lod::BoardCosts& board : lod::boards())
    for (const int fps : {30, 60}) {
      for (const char* policy : {"controller", "controller_no_fence"})
        for (const std::uint64_t seed : {1u, 2u, 3u}) register_day(board, fps, policy, seed);
      for (const char* policy : {"fixed", "reactive"}) register_day(board, fps, policy, 1);
    }
  return at_end(print_table);
}
[[maybe_unused]] const bool registered = register_days();

// One step in the dead zone, 32 objects: what every frame pays.
void step(benchmark::State& state) {
  std::array<lod::ObjectNeed, kMaxObjects> objects;
  for (lod::ObjectNeed& o : objects) o = {100, 1500, 20000.0f, 1.0f, 1.0f, 0.3f, 1.0f, 0.3f};
  const lod::SceneNeeds needs{objects, 1920.0f * 1080.0f, false};
  lod::LodConfig config;
  config.vblanks_per_frame = 1;
  config.prior = lod::boards()[0];
  lod::BudgetController controller(config);
  lod::VirtualBoard board(config.prior, 1);
  controller.begin(needs);
  sim::Disturbances noise(1);
  noise.quiet();
  const lod::Work work{20000, 6000, 0, 1e6f, 0.6e6f, lod::Shading::per_pixel};
  std::vector<lod::FrameSample> samples;
  for (int n = 0; n < 4096; ++n) samples.push_back(board.run(work, 1, noise.next(board.time_us())));
  const auto run = [&](int n) { return controller.step(samples[n & 4095], needs).predicted_us; };
  std::uint64_t hash = kHashSeed;
  for (int n = 0; n < 4096; ++n) {
    const float predicted = run(n);
    hash = hash_of(std::span<const float>(&predicted, 1), hash);
  }
  int n = 0;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(run(n++));
  state.SetLabel(label_of(hash));
}
BENCHMARK(step)->Name("lod/step");

}  // namespace
}  // namespace caryatid::bench
