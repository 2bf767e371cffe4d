// caryatid: the agent's program. Exit codes: 0 done, 1 failed at run time, 2 wrong usage.
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>

#include "core/body/bap_table.h"
#include "firmware-app/kiosk.h"
#include "firmware-app/options.h"
#include "firmware-app/reload.h"

namespace {

void on_signal(int) { caryatid::app::Kiosk::request_stop(); }

void close_line(const caryatid::app::Options& options, const caryatid::app::RunReport& r) {
  std::printf(
      "caryatid: %llu frames in %.2f s, %llu late, %llu allocations after the seal, arena %.2f MiB",
      static_cast<unsigned long long>(r.frames), r.seconds,
      static_cast<unsigned long long>(r.late_frames),
      static_cast<unsigned long long>(r.allocations),
      static_cast<double>(r.arena_bytes) / 1048576.0);
  if (!options.frames_out.empty()) std::printf("; pictures in %s", options.frames_out.c_str());
  if (!options.metrics.empty())
    std::printf("; metrics %s %s", r.metrics_lost ? "are not whole in" : "in",
                options.metrics.c_str());
  std::putchar('\n');
  if (r.limited_frames > 0)
    std::printf(
        "caryatid: joints beyond human limits in %llu frames; the farthest %s, by %.0f degrees\n",
        static_cast<unsigned long long>(r.limited_frames),
        caryatid::body::bap_info(r.worst_limit.worst_bap).name,
        static_cast<double>(r.worst_limit.worst_excess_rad) * 57.29578);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace caryatid::app;
  Options options;
  switch (parse_options(argc, argv, &options)) {
    case Parsed::done:
      return 0;
    case Parsed::wrong:
      return 2;
    case Parsed::run:
      break;
  }
  if (!options.compile.empty()) return compile_to_stdout(options.compile);
  if (options.check) return Kiosk::check(options) ? 0 : 1;
  if (options.list_hardware) return Kiosk::list_hardware(options) ? 0 : 1;
  std::signal(SIGTERM, on_signal);
  std::signal(SIGINT, on_signal);
  if (options.test_faults) {
    std::signal(SIGUSR1, [](int) { Kiosk::stop_flips(); });
    std::signal(SIGUSR2, [](int) { Kiosk::reset_gpu(); });
    std::signal(SIGRTMIN, [](int) { Kiosk::stop_input(); });
  }
  // Large: meshes, tables and buffers of fixed size stand inside it.
  auto kiosk = std::make_unique<Kiosk>(options);
  if (!kiosk->start() || !kiosk->run()) return 1;
  close_line(options, kiosk->report());
  std::fflush(stdout);
  kiosk->close_screen();
  // A sound or USB driver that hangs must not keep the program beyond its second.
  std::signal(SIGALRM, [](int) { _exit(0); });
  const itimerval soon{{0, 0}, {0, 600'000}};
  (void)setitimer(ITIMER_REAL, &soon, nullptr);
  kiosk.reset();
  return 0;
}
