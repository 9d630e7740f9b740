#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "kernels/quality/cell_shape.h"

namespace strataflow {

/// What can be said about one cell by itself.
struct CellMeasures {
  /// Volume inside the bilinear faces, so that neighbours agree about the quadrilateral between them; negative when
  /// the cell is inside out.
  double volume_m3 = 0;
  /// Per edge between two faces, [0, 180]. At an edge of a quadrilateral the face normals are those at the edge's two
  /// ends, so such an edge counts twice.
  std::array<double, 24> dihedral_deg{};
  std::uint32_t dihedral_count = 0;
  /// Smallest determinant of three unit edge vectors over all corners (and the pyramid's apex frames), divided by its
  /// value in the ideal cell: 1 is best, ≤ 0 is inverted.
  double scaled_jacobian = 0;
  /// (1/n) Σ det J_k over the n corners (coudert2024 S2, 1.3, before dividing by V_ref); 6 volumes for a tetrahedron.
  double mean_corner_determinant = 0;
  std::optional<double> radius_ratio;  ///< tetrahedra: 3 r_in / R_circum, 1 if regular
  std::optional<double> shape;  ///< Knupp 2003: 1 for a regular tetrahedron, cube; also prisms, by their corner frames
  std::optional<double> skew;   ///< Knupp 2003, hexahedra: 1 for any rectangular box
};

/// Measures one cell given its vertices in VTK's order.
CellMeasures measure_cell(CellType type, std::span<const Vec3> vertices);

/// `volume_m3` of measure_cell alone.
double cell_volume(CellType type, std::span<const Vec3> vertices);

/// Knupp's relative size (coudert2024 S2, 1.4): min(τ, 1/τ), 1 at the reference size, 0 if τ ≤ 0.
double relative_size(double mean_corner_determinant, double reference_determinant);

/// True if any corner determinant is ≤ 0, decided exactly. All corners positive does not prove that a trilinear cell
/// is valid everywhere inside (coudert2024 S2).
bool is_inverted(CellType type, std::span<const Vec3> vertices);

}  // namespace strataflow
