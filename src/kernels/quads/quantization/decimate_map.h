#pragma once
#include "base/result.h"
#include "kernels/quads/quantization/cut_chart.h"
#include "kernels/quads/quantization/flat_mesh.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// What a point is to the quad mesh.
enum class PointKind : std::uint8_t {
  gone,     ///< not in the decimated mesh
  free,     ///< there for topology only: nothing makes it a vertex of the quad mesh
  integer,  ///< a singularity, an end, corner or junction of features, or a point that holds a closed feature
};

/// A map on as few triangles as its singularities and features allow (coudert2024 S38).
struct DecimatedMap {
  FlatMesh mesh;                       ///< charts of the cut; no unused triangles
  std::vector<LinearForm> forms;       ///< per half-edge: its vector as a form over the variables of the cut
  std::vector<std::int32_t> bearing;   ///< per half-edge: quarters from its point's first corner, see quarter_bearings
  std::vector<PointKind> kind;         ///< per point
  std::vector<std::int32_t> quarters;  ///< per point: all quarters around it in the map
  std::uint32_t flips = 0;
  bool is_embedded = true;  ///< no curve was bent by more than rounding: the triangles lie in the surface
};

struct DecimateOptions {
  bool keep_shape = false;  ///< never straighten a free boundary or a feature that the map does not follow
};

/// Per half-edge the quarter of its direction, counted counter-clockwise around its origin from the direction of the
/// real axis at the point's first corner; whole numbers, modulo the point's quarters inside.
std::vector<std::int32_t> quarter_bearings(const FlatMesh& flat, const CutChart& cut,
                                           const std::vector<std::int32_t>& quarters);

/// Per point: quarters around it (inside: the number of quads of a quad mesh there).
std::vector<std::int32_t> quarters_around(const FlatMesh& flat, std::size_t point_count);

/// Removes every regular point that neither is a listed corner nor ends or bends a feature. Instead of collapsing edges
/// (S38) a point is removed by flipping its edges away: that needs no link condition, works on loops and double
/// edges, and what remains is the constrained Delaunay triangulation of the points that must stay, in whichever
/// order they are taken. All areas are positive at each step, exactly.
DecimatedMap decimate_map(const FeatureMesh& mesh, const FlatMesh& flat, const CutChart& cut,
                          const DecimateOptions& options = {});

}  // namespace strataflow
