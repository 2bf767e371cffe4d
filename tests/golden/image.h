#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace caryatid::golden {

struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

// Errors of 8-bit values, over all channels of all pixels.
struct Difference {
  double mean = 0.0;
  int percentile_99_9 = 0;
};
Difference compare(const Image& a, const Image& b);  // Same size.

Image read_png(const std::string& path);  // Empty when it can't be read.
bool write_png(const Image& image, const std::string& path);

// Asserts (GoogleTest) that `image` is near tests/golden/images/NAME.png. Drivers round and
// antialias in their own ways: a mean of 1.0 and a 99.9th percentile of 24 are allowed. On failure
// the picture lies under the build's out/golden for a look; after one, CARYATID_UPDATE_GOLDEN=1
// makes it the new truth.
void expect_golden(const Image& image, const std::string& name);

}  // namespace caryatid::golden
