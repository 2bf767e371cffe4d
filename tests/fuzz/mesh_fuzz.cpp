// Readers of OBJ, OFF, PLY and history files: any bytes end in a surface or in one exception. What
// is read must survive repair and simplification. The first byte chooses the reader; 4 is a history
// whose checksums are made to fit first, so that what lies behind them is reached.
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/mesh_io/repair.h"
#include "assets/bake/simplify/history.h"
#include "core/base/crc.h"

namespace {

// Layout: FileHeader of history.cpp, 48 bytes: counts of the base at 12, checksums at 36, 40, 44.
std::string sealed(std::string_view bytes) {
  std::string out(bytes);
  if (out.size() < 48) return out;
  const auto word = [&out](std::size_t at) {
    std::uint32_t v = 0;
    std::memcpy(&v, &out[at], sizeof v);
    return v;
  };
  const auto seal = [&out](std::size_t at, std::size_t first, std::size_t count) {
    const std::uint32_t crc = caryatid::crc32c(std::as_bytes(std::span(&out[first], count)));
    std::memcpy(&out[at], &crc, sizeof crc);
  };
  const std::uint64_t base = 24ull * word(12) + 12ull * word(16), rest = out.size() - 48;
  if (base <= rest && rest > 0) {
    if (base > 0) seal(36, 48, base);
    if (base < rest) seal(40, 48 + base, rest - base);
  }
  seal(44, 0, 44);
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid::bake;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const int reader = data[0] % 5;
    if (reader >= 3) {
      const History history =
          parse_history(reader == 4 ? sealed(bytes) : std::string(bytes), "fuzz");
      HistoryCursor cursor(history);
      cursor.go_to(history.max_triangles());
      cursor.go_to(0);
      return 0;
    }
    RepairReport report;
    const Surface s =
        repair_surface(parse_mesh(bytes, static_cast<MeshFormat>(reader), "fuzz"), &report);
    CollapseOptions options;
    options.target_triangles = static_cast<std::uint32_t>(s.triangles.size() / 4);
    (void)collapse_edges(s, options);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
