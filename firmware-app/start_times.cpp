#include "firmware-app/start_times.h"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace caryatid::app {

double process_age_s() {
  char text[1024] = {};
  const int file = ::open("/proc/self/stat", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0.0;
  const ssize_t bytes = ::read(file, text, sizeof text - 1);
  ::close(file);
  // Field 22 of proc(5); fields are counted behind the name, which may hold anything.
  const char* at = bytes > 0 ? std::strrchr(text, ')') : nullptr;
  for (int field = 2; at != nullptr && field < 22; ++field) at = std::strchr(at + 1, ' ');
  if (at == nullptr) return 0.0;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double ticks = static_cast<double>(std::strtoull(at, nullptr, 10));
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9 -
         ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace caryatid::app
