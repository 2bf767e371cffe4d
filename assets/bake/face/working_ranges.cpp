#include "assets/bake/face/working_ranges.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace caryatid::bake::fat {

WorkingRanges read_working_ranges(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  WorkingRanges ranges;
  std::array<bool, face::kFapCount + 1> seen{};
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#' || line.starts_with("fap,")) continue;
    std::istringstream fields(line);
    std::size_t fap = 0;
    float low = 0, high = 0;
    char comma = 0;
    if (!(fields >> fap >> comma >> low >> comma >> high) || fap < 3 || fap > face::kFapCount ||
        low > 0 || high < 0)
      throw std::runtime_error(file.string() + ":" + std::to_string(number) +
                               ": expected FAP (3..68), low <= 0, high >= 0, muscles, source");
    std::string muscles;
    if (!(fields >> comma) || !std::getline(fields, muscles, ',') || muscles.empty())
      throw std::runtime_error(file.string() + ":" + std::to_string(number) +
                               ": name the muscles behind the FAP after its range");
    seen[fap] = true;
    ranges.low[fap] = low;
    ranges.high[fap] = high;
  }
  for (std::size_t fap = 3; fap < seen.size(); ++fap)
    if (!seen[fap])
      throw std::runtime_error(file.string() + ": no line for FAP " + std::to_string(fap));
  return ranges;
}

}  // namespace caryatid::bake::fat
