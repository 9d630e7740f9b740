#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/hybrid/thin_cell.h"
#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// The cells of one region, whose worst shall become better. Points of `is_free` lie on nothing and may move.
struct ImprovableCells {
  std::vector<Vec3> points;
  std::vector<char> is_free;     ///< per point
  std::vector<Tet> tets;         ///< may be exchanged for others
  std::vector<ThinCell> kept;    ///< cells that stay, but whose free points move
  std::vector<Triangle> facets;  ///< faces of `tets` that stay: on surfaces, or shared with other cells
};

/// What was done, and the smallest scaled Jacobian of the tetrahedra and of kept cells with free points.
struct CellImprovement {
  std::uint64_t exchanges = 0;     ///< edges and faces taken out
  std::uint64_t moves = 0;         ///< of free points
  std::uint64_t added_points = 0;  ///< on edges inside, where nothing else helped: at the end of `points`
  double smallest_before = 1, smallest_after = 1;
  template <class A>
  void archive(A& a) {
    a(exchanges, moves, added_points, smallest_before, smallest_after);
  }
};

/// Raises the smallest scaled Jacobians step by step, the worst cells first in each round: takes edges inside out of
/// their rings (the best of all triangulations of the ring, Klincsek 1980), takes faces out (two tetrahedra become
/// three), moves free points, and where that does not help sets a free point on an edge inside. A step is made only
/// where the smallest scaled Jacobian of the cells it replaces rises, so valid cells stay valid; points that are not
/// free and facets stay. Serial, in an order that depends on indices alone. The mesh may still need verification: sums
/// of volumes are not looked at.
CellImprovement improve_cells(ImprovableCells& cells);

}  // namespace strataflow
