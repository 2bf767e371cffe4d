#pragma once
// The history of a simplification: the coarsest mesh, and the splits that lead from it back to the
// original, bit for bit. In the file the base mesh comes first, so that a reader can show it while
// the splits still arrive (progressive transmission after Hoppe 1996).
#include <string>
#include <string_view>

#include "assets/bake/simplify/edge_collapse.h"

namespace caryatid::bake {

struct History {
  struct Split {
    std::uint32_t parent = 0;                // Splits; the new vertex follows all before it.
    std::uint32_t triangle_count = 0;        // New: 1 at a border, else 2.
    Vec3d coarse{0}, parent_x{0}, new_x{0};  // Where they stand before and after.
    std::array<Triangle, 2> corners{};       // Of the new triangles, which follow all before them.
    std::uint32_t first_moved = 0, moved_count = 0;
  };
  Surface base;
  std::vector<Split> splits;         // Coarse to fine.
  std::vector<std::uint32_t> moved;  // 3 * triangle + corner where parent becomes the new vertex.
  // Numbers in the original, by number here. A level is given out in that order, so that the finest
  // is the original itself.
  std::vector<std::uint32_t> vertex_origin, triangle_origin;

  std::uint32_t max_triangles() const { return static_cast<std::uint32_t>(triangle_origin.size()); }
};

// Simplifies as far as it goes, at most to `base_triangles`, and keeps the way back.
History record_history(Surface surface, CollapseOptions options, CollapseReport* report = nullptr);

// Walks up and down a history. Borrows it.
class HistoryCursor {
 public:
  explicit HistoryCursor(const History& history);
  // To the finest level of at most `triangles`, or the base. O(splits between).
  void go_to(std::uint32_t triangles);
  std::uint32_t triangle_count() const { return triangle_count_; }
  std::uint32_t split_count() const { return cursor_; }
  Surface surface() const;

 private:
  void apply(const History::Split& split);
  void undo(const History::Split& split);

  const History& history_;
  std::vector<Vec3d> position_;
  std::vector<Triangle> triangles_;
  std::uint32_t cursor_ = 0, triangle_count_ = 0, vertex_count_ = 0;
};

// The file: header, base part and splits, each with a CRC-32C. parse throws std::runtime_error
// "NAME:1: what" on anything that is not what format wrote.
std::string format_history(const History& history);
History parse_history(std::string_view bytes, const std::string& name);

}  // namespace caryatid::bake
