#pragma once
#include <cstdint>
#include <vector>

#include "model/hex_grid.h"

namespace strataflow {

/// The cells of a grid that have a volume, as a mesh of its own: corners that coincide beside cells without thickness are
/// one point, and what lies below and above such cells touches, with one facet between.
struct LiveCells {
  VolumeMesh mesh;
  std::vector<std::uint32_t> grid_cell;  ///< per cell of the mesh
  template <class A>
  void archive(A& a) {
    a(mesh, grid_cell);
  }
};

/// Needs `is_dead` (judge_cells). Cells keep their order, points that of their first use by number.
LiveCells live_cells(const HexGrid& hexes);

}  // namespace strataflow
