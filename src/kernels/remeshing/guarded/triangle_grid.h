#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/id.h"
#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

/// Boxes of triangles that come and go, in uniform grids of cells over a fixed box, each four times as coarse as the
/// one before; a box lies in the first grid where it meets few cells. What sticks out of the fixed box counts to the
/// outermost cells. A visit's order depends only on the order of insertions and erasures.
class TriangleGrid {
 public:
  TriangleGrid() = default;
  /// The finest cells are at least `cell_m` wide, wider where there would be more than `most_cells`.
  TriangleGrid(const Box3& box, double cell_m, std::size_t most_cells);

  /// `triangle` is not in the grid.
  void insert(std::uint32_t triangle, const FloatBox& box);
  /// `triangle` is in the grid.
  void erase(std::uint32_t triangle);
  /// The same as erase and insert, often cheaper.
  void move(std::uint32_t triangle, const FloatBox& box);
  const FloatBox& box(std::uint32_t triangle) const { return boxes_[triangle]; }

  /// Calls visit(triangle) at least once, perhaps several times, for every triangle whose box overlaps `box`.
  template <class Visit>
  void visit(const FloatBox& box, Visit&& visit) const {
    for (const Level& level : levels_) {
      if (level.triangles == 0) continue;
      level.for_each_cell(level.cells_of(box), [&](std::size_t cell) {
        for (std::uint32_t node = level.heads[cell]; node != no_index; node = nodes_[node].next)
          if (overlap(nodes_[node].box, box)) visit(nodes_[node].triangle);
      });
    }
  }

 private:
  struct Node {
    std::uint32_t triangle = 0, next = no_index;
    FloatBox box;  ///< the triangle's, once more: looking it up there misses the caches
  };
  struct Cells {
    std::array<int, 3> from, to;
    friend bool operator==(const Cells&, const Cells&) = default;
  };
  struct Level {
    Vec3 low;
    double per_m = 0;
    std::array<int, 3> cells{1, 1, 1};
    std::vector<std::uint32_t> heads;
    std::uint32_t triangles = 0;

    int cell_of(float x, int axis) const {
      const double k = (x - low[axis]) * per_m;
      return k > 0 ? static_cast<int>(std::min<double>(k, cells[axis] - 1)) : 0;
    }
    Cells cells_of(const FloatBox& box) const {
      Cells met;
      for (int axis = 0; axis < 3; ++axis) {
        met.from[axis] = cell_of(box.low[axis], axis);
        met.to[axis] = cell_of(box.high[axis], axis);
      }
      return met;
    }
    template <class Visit>
    void for_each_cell(const Cells& met, Visit&& visit) const {
      for (int z = met.from[2]; z <= met.to[2]; ++z)
        for (int y = met.from[1]; y <= met.to[1]; ++y)
          for (int x = met.from[0]; x <= met.to[0]; ++x)
            visit((static_cast<std::size_t>(z) * cells[1] + y) * cells[0] + x);
    }
  };

  /// The level a box belongs to.
  std::size_t level_of(const FloatBox& box) const;

  std::vector<Level> levels_;
  std::vector<Node> nodes_;
  std::uint32_t free_node_ = no_index;
  std::vector<FloatBox> boxes_;  ///< per triangle
};

}  // namespace strataflow
