#pragma once
// From kiosk.toml and its texts to the compiled programme (core/agent/programme.h). See
// assets/programme/kiosk.toml for every key with an example.
//
// Faults never stop a kiosk: each is a message with file and line, and something sensible takes the
// place of what is missing (another language, the plain text, the page without its picture).
#include <cstddef>
#include <string>
#include <vector>

#include "firmware-app/texts/files.h"
#include "firmware-app/texts/shaper.h"

namespace caryatid::app {

struct CompiledProgramme {
  std::vector<std::byte> block;  // Empty: kiosk.toml itself can't be read.
  Messages messages;
};

inline constexpr std::size_t kMostConfigBytes = 256 * 1024;

CompiledProgramme compile_programme(ProgrammeFiles& files, const pack::FontView& font);

}  // namespace caryatid::app
