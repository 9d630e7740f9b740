#pragma once
#include <cstdint>
#include <vector>

#include "kernels/remeshing/dual/dual_polygons.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A dual as surfaces to build a model from, and where everything came from.
struct DualSoup {
  TriangleSoup soup;  ///< a patch for each surface of the model, in order; then one for each set of joined surfaces
  std::vector<std::vector<std::uint32_t>> patch_surfaces;  ///< per patch: surfaces of the model, ascending
  std::vector<DualPoint> points;                           ///< per point of the soup
  std::vector<std::uint32_t> corner_point;  ///< per corner of the model; no_index where no triangle is left at it
  std::vector<std::vector<std::uint32_t>> line_points;  ///< as in DualMesh, without points of no triangle
};

/// Makes one of triangles of several surfaces with the same three points, on a patch that names all their entities, and
/// leaves out points of no triangle.
DualSoup make_dual_soup(const StructuralModel& model, const DualMesh& mesh);

}  // namespace strataflow
