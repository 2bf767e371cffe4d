#include "platform/inventory/gpio_lines.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace caryatid::platform {

// The kernel's own interface (linux/gpio.h, v1 calls, there since 4.8): both libgpiod stand on it.
int list_gpio_lines(std::FILE* out, const char* path) {
  const int chip = ::open(path, O_RDONLY | O_CLOEXEC);
  if (chip < 0) return errno;
  gpiochip_info info{};
  if (::ioctl(chip, GPIO_GET_CHIPINFO_IOCTL, &info) != 0) {
    const int error = errno;
    ::close(chip);
    return error;
  }
  std::fprintf(out, "  %s \"%s\", %u lines; gpio = { chip = \"%s\", offset = N }\n", info.name,
               info.label, info.lines, info.name);
  for (unsigned i = 0; i < info.lines; ++i) {
    gpioline_info line{};
    line.line_offset = i;
    if (::ioctl(chip, GPIO_GET_LINEINFO_IOCTL, &line) != 0) continue;
    if (line.name[0] == '\0' && line.consumer[0] == '\0') continue;
    std::fprintf(out, "    %3u  %-24s%s%s\n", i, line.name[0] != '\0' ? line.name : "(no name)",
                 line.consumer[0] != '\0' ? "  in use by " : "", line.consumer);
  }
  ::close(chip);
  return 0;
}

}  // namespace caryatid::platform
