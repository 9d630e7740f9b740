#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/quality/match_cell_faces.h"

namespace strataflow {

/// Boundary faces and vertices that touch without sharing numbers.
struct BoundaryContacts {
  /// Faces with a vertex of other faces inside them or inside one of their edges (T-junctions), ascending indices into
  /// the faces given.
  std::vector<std::uint32_t> faces_with_hanging_vertex;
  /// Vertices that lie on a vertex of smaller number: seams that were never welded, or split on purpose.
  std::uint64_t coincident_vertices = 0;
};

/// Looks for both within `tolerance_m`. A quadrilateral counts as its two triangles along one diagonal. Needs
/// finite points.
BoundaryContacts find_hanging_vertices(std::span<const Vec3> points, std::span<const CellFace> boundary_faces,
                                       double tolerance_m);

}  // namespace strataflow
