#pragma once
// Pictures that the program wrote.
#include <filesystem>
#include <vector>

namespace caryatid::golden {

struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
  std::size_t at(int x, int y) const {
    return std::size_t{3} * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x));
  }
};

// Empty when the file is no PNG.
Pixels read_png(const std::filesystem::path& file);

}  // namespace caryatid::golden
