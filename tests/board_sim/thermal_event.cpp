// board_sim_thermal_event BOARD FPS OUT_DIR: three minutes of one board with a throttling of 80 s
// in the middle, under each policy, as metrics for `caryatid-tool plot metrics`. For README's
// figure.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/board_sim/simulation.h"

namespace {

using namespace caryatid;

bool write_run(const lod::BoardCosts& board, int fps, sim::Policy policy, const std::string& dir) {
  sim::Scenario scenario;
  scenario.board = board;
  scenario.vblanks_per_frame = static_cast<std::uint16_t>(60 / fps);
  scenario.policy = policy;
  scenario.hours = 180.0 / 3600.0;
  scenario.scene_moves = false;
  sim::Simulation simulation(scenario);
  simulation.disturbances().quiet();
  simulation.disturbances().throttle_now(60'000'000, 80, true);
  const std::string path = dir + "/" + sim::name_of(policy) + ".jsonl";
  std::FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) return false;
  simulation.run([&](const sim::Trace& t) {
    std::fprintf(out,
                 "{\"time_s\":%.4f,\"cpu_ms\":%.3f,\"gpu_ms\":%.3f,\"late\":%s,\"triangles\":%u,"
                 "\"render_scale\":%.3f,\"throttled\":%s}\n",
                 t.time_s, t.cpu_us * 1e-3, (t.frame_us - t.cpu_us) * 1e-3,
                 t.late ? "true" : "false", t.triangles, static_cast<double>(t.render_scale),
                 t.throttled ? "true" : "false");
  });
  return std::fclose(out) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const lod::BoardCosts* board =
      argc == 4 ? lod::find_board({argv[1], std::strlen(argv[1])}) : nullptr;
  const int fps = argc == 4 ? std::atoi(argv[2]) : 0;
  if (board == nullptr || (fps != 30 && fps != 60)) {
    std::fputs("board_sim_thermal_event BOARD 30|60 OUT_DIR\n", stderr);
    return 2;
  }
  for (const sim::Policy policy :
       {sim::Policy::controller, sim::Policy::fixed, sim::Policy::reactive})
    if (!write_run(*board, fps, policy, argv[3])) return 1;
  return 0;
}
