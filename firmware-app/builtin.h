#pragma once
// What is compiled into the program: the letters of captions and the default programme's files
// (assets/programme), by their names beside kiosk.toml. The face is in pack_file.h.
#include <span>
#include <vector>

#include "firmware-app/texts/files.h"

namespace caryatid::app {

std::span<const std::byte> builtin_font();
std::vector<BuiltinFile> builtin_programme();

}  // namespace caryatid::app
