#pragma once
// How far each FAP of a human face goes: assets/characters/fap_working_ranges.csv. The coding
// ranges of streams are far wider than any face.
#include <array>
#include <filesystem>

#include "core/face/fap.h"

namespace caryatid::bake::fat {

struct WorkingRanges {
  // By FAP number, in the FAP's own unit; low <= 0 <= high.
  std::array<float, face::kFapCount + 1> low{};
  std::array<float, face::kFapCount + 1> high{};
};

// Columns fap,low,high,muscles,source; `#` lines are comments; muscles and source are for who reads
// the table. Throws std::runtime_error naming file and
// line when a line is wrong or a FAP 3..68 is missing.
WorkingRanges read_working_ranges(const std::filesystem::path& file);

}  // namespace caryatid::bake::fat
