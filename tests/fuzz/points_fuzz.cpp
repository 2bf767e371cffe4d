// The list of feature points of a foreign head: any bytes end in points or in one exception, and
// any points on a mesh end in a head that is understood or in one exception, without a number that
// is none.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "assets/bake/head/openings.h"
#include "assets/bake/mesh_io/mesh_io.h"

namespace {

const caryatid::bake::Surface& mesh() {
  static const caryatid::bake::Surface surface =
      caryatid::bake::read_mesh(CARYATID_SOURCE_DIR "/tests/data/heads/coarse_head.obj");
  return surface;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid::bake::foreign;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const PointList points = parse_points(text, "fuzz");
    PlacedHead head = place_head(mesh(), points);
    (void)open_head(points, head);
    for (const caryatid::Vec3& p : head.position_m)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) std::abort();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
