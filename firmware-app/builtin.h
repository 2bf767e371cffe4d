#pragma once
// What is compiled into the program: the letters of captions, the first picture, and the default
// programme's files (assets/programme), by their names beside kiosk.toml. The face is in
// pack_file.h.
#include <span>
#include <string_view>
#include <vector>

#include "firmware-app/texts/files.h"

namespace caryatid::app {

std::span<const std::byte> builtin_font();
// A JPEG, twice as wide as high: her head, with room at both sides. Made by
// caryatid-tool render --pack woman.pack --view front --size 2048x1024, halved.
std::string_view builtin_picture();
std::vector<BuiltinFile> builtin_programme();

}  // namespace caryatid::app
