#pragma once
#include <cstdint>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// An edge of a line of the model; first < second.
struct LineSegment {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::uint32_t line = 0;
};

/// The triangles of a model, with the points that had to be inserted on them so far.
struct SurfaceTriangles {
  std::vector<Vec3> points;         ///< the model's, then the inserted ones
  std::vector<Triangle> triangles;  ///< surface by surface, as in the model
  std::vector<std::uint32_t> triangle_surface;
  std::vector<std::int32_t> point_line;  ///< per point: its line, −1 elsewhere
  std::vector<LineSegment> segments;     ///< by first, then second
};

SurfaceTriangles surface_triangles_of(const StructuralModel& model);

/// The piecewise linear complex around and inside one region: every triangle that one of its sides looks at.
struct RegionBoundary {
  std::uint32_t region = 0;
  std::vector<std::uint32_t> triangles;  ///< indices into SurfaceTriangles, ascending
  std::vector<std::uint8_t> sides;       ///< per triangle: 1 negative side, 2 positive side, 3 both (dangling)
  std::vector<std::uint32_t> points;     ///< indices into SurfaceTriangles, ascending
  std::vector<Vec3> coordinates;         ///< per point
  std::vector<Triangle> facets;          ///< per triangle: indices into `points`
};

RegionBoundary region_boundary(const StructuralModel& model, const SurfaceTriangles& surfaces, std::uint32_t region);

}  // namespace strataflow
