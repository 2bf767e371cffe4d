#include "assets/tool/progress.h"

#include <unistd.h>

#include <cstdio>

namespace caryatid::tool {

void Progress::step(const std::string& what) {
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - began_).count();
  if (isatty(STDERR_FILENO) != 0) {
    std::fprintf(stderr, "\r\033[K%5.1f s  %s", seconds, what.c_str());
    shown_ = true;
  } else if (now - said_ >= std::chrono::seconds(5)) {
    std::fprintf(stderr, "caryatid-tool: %.0f s: %s\n", seconds, what.c_str());
    said_ = now;
  }
}

void Progress::step(const std::string& what, std::size_t done, std::size_t total) {
  step(what + " " + std::to_string(done) + " of " + std::to_string(total));
}

Progress::~Progress() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
}

}  // namespace caryatid::tool
