// Readers of OBJ, OFF, PLY and history files: any bytes end in a surface or in one exception. What
// is read must survive repair and simplification. The first byte chooses the reader.
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "assets/bake/mesh_io/mesh_io.h"
#include "assets/bake/mesh_io/repair.h"
#include "assets/bake/simplify/history.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace caryatid::bake;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] % 4 == 3) {
      const History history = parse_history(bytes, "fuzz");
      HistoryCursor cursor(history);
      cursor.go_to(history.max_triangles());
      cursor.go_to(0);
      return 0;
    }
    RepairReport report;
    const Surface s =
        repair_surface(parse_mesh(bytes, static_cast<MeshFormat>(data[0] % 4), "fuzz"), &report);
    CollapseOptions options;
    options.target_triangles = static_cast<std::uint32_t>(s.triangles.size() / 4);
    (void)collapse_edges(s, options);
  } catch (const std::runtime_error&) {
  }
  return 0;
}
