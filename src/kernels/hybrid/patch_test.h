#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// How finite elements on a mesh reproduce linear fields.
struct PatchTestReport {
  std::uint64_t unknowns = 0;           ///< vertices inside
  std::uint64_t boundary_vertices = 0;  ///< where the field is given
  /// Largest difference at a vertex, of the fields x, y and z, divided by the mesh's diagonal.
  double max_error_ratio = 0;
  /// Largest difference of ∫ |∇u|² from the volume, of the same fields, divided by the volume: are the cells' volumes
  /// theirs, whatever is inside.
  double energy_error_ratio = 0;
  bool passes() const { return max_error_ratio <= 1e-8 && energy_error_ratio <= 1e-8; }
  template <class A>
  void archive(A& a) {
    a(unknowns, boundary_vertices, max_error_ratio, energy_error_ratio);
  }
};

/// Solves Laplace's equation with linear fields given on the boundary, by isoparametric elements on tetrahedra,
/// pyramids, prisms and hexahedra, whose shape functions are those of a hexahedron with vertices that coincide: linear
/// on triangles, bilinear on quadrilaterals, so that cells of all types fit. Where the mesh conforms and no cell is
/// inverted the result is the field itself.
/// Fails with invalid_input for a mesh without cells or with indices out of range, geometry_failed for one with a cell
/// whose map turns over.
Result<PatchTestReport> run_patch_test(const VolumeMesh& mesh);

using ScalarField = std::function<double(const Vec3&)>;

struct PoissonSolution {
  std::vector<double> values;  ///< per point; 0 at points of no cell
  double error_l2 = 0;         ///< √∫ (u − exact)²
};

/// −Δu = source with u = exact on the boundary, by the same elements. Positions are the mesh's own.
Result<PoissonSolution> solve_poisson(const VolumeMesh& mesh, const ScalarField& source, const ScalarField& exact);

}  // namespace strataflow
