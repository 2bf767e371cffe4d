#pragma once
// Whole text files, under the names that the tool's commands use.
#include "assets/bake/files/files.h"

namespace caryatid::tool {

inline std::string read_text(const std::string& path) { return bake::read_file(path); }
inline void write_text(const std::string& path, const std::string& text) {
  bake::write_file(path, text);
}

}  // namespace caryatid::tool
