#pragma once
#include <cstdio>

namespace caryatid::platform {

// Writes the chip at `path` and its named or used lines. Returns 0 or errno.
int list_gpio_lines(std::FILE* out, const char* path);

}  // namespace caryatid::platform
