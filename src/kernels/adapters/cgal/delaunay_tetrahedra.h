#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// The Delaunay triangulation of points in space. Each tetrahedron is dual to a Voronoi vertex, each face to an edge.
struct DelaunayTetrahedra {
  /// By their sorted corners, ascending. The first three corners turn counter-clockwise seen from the fourth.
  std::vector<std::array<std::uint32_t, 4>> tets;
  /// Per tetrahedron and corner: the tetrahedron beyond the face without that corner, no_index on the convex hull.
  std::vector<std::array<std::uint32_t, 4>> beyond;
};

/// Exact, and the same for any order of work: of points on a sphere the triangulation that symbolic perturbation by
/// their coordinates picks. Of points at one position the lowest counts. Empty where all lie in a plane.
DelaunayTetrahedra delaunay_tetrahedra(std::span<const Vec3> points);

}  // namespace strataflow
