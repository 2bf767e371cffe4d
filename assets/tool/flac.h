#pragma once
#include <string>

#include "assets/tool/spoken.h"

namespace caryatid::tool {

// A FLAC file of one or two channels and 8 to 24 bits, mixed down to one channel of 16 bits; no
// events. Throws std::runtime_error, one line.
Spoken read_flac(const std::string& path);

}  // namespace caryatid::tool
