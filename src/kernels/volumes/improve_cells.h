#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// What makes a tetrahedron good: both are 1 at most, 0 where it is flat, negative where it is turned over.
enum class TetMeasure : std::uint8_t {
  scaled_jacobian,
  smallest_sine  ///< of its dihedral angles; turns at 0 and at 180°
};

/// The cells of one region, whose worst shall become better. Points of `is_free` lie on nothing and may move.
struct ImprovableCells {
  std::vector<Vec3> points;
  std::vector<char> is_free;     ///< per point
  std::vector<Tet> tets;         ///< may be exchanged for others
  std::vector<Triangle> facets;  ///< faces of `tets` that stay: on surfaces, or shared with other cells
  TetMeasure measure = TetMeasure::scaled_jacobian;
  double good_enough = 0.25;    ///< measure above which a tetrahedron is left alone
  double worth_a_point = 0.12;  ///< below which a point is added for it
  /// The smallest measure of the cells that stay but have this free point, 1 where there is none. Absent: there
  /// are no such cells.
  std::function<double(std::uint32_t point, const std::vector<Vec3>& points)> worst_kept_at;
};

/// Those of a region: its interior points are free, and its facets stay.
ImprovableCells improvable_cells(const RegionBoundary& boundary, const RegionMesh& mesh);

/// What was done, and the smallest measure of the tetrahedra and of kept cells with free points.
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

/// Raises the smallest measures step by step, the worst cells first in each round: takes edges inside out of
/// their rings (the best of all triangulations of the ring, Klincsek 1980), takes faces out (two tetrahedra become
/// three), moves free points, and where that does not help sets a free point on an edge inside. A step is made only
/// where the smallest measure of the cells it replaces rises, so valid cells stay valid; points that are not
/// free and facets stay. Serial, in an order that depends on indices alone. The mesh may still need verification: sums
/// of volumes are not looked at.
CellImprovement improve_cells(ImprovableCells& cells);

}  // namespace strataflow
