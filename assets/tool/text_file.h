#pragma once
// Whole text files, with errors as the tool words them.
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace caryatid::tool {

inline std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + ":1: cannot be read; check the name");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush())
    throw std::runtime_error(path + ":1: cannot be written; check folder and space");
}

}  // namespace caryatid::tool
