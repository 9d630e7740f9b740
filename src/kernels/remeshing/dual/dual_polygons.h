#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernels/remeshing/dual/component_points.h"

namespace strataflow {

/// What the dual could not represent.
enum class DualFlawKind : std::uint8_t {
  closed_chain,      ///< two cells meet along a closed curve: it has no dual
  not_a_disc,        ///< a surface component with a hole, a handle, or several borders
  turned_triangle,   ///< faces away from the surface it stands for
  repeated_triangle  ///< three points twice, turning alike, in one surface: kept once
};

std::string_view to_string(DualFlawKind kind);

struct DualFlaw {
  DualFlawKind kind = DualFlawKind::closed_chain;
  std::uint32_t site = 0;
  std::uint32_t surface = 0;
  static constexpr bool is_flat = true;
  friend constexpr auto operator<=>(const DualFlaw&, const DualFlaw&) = default;
};

/// The remeshed surfaces, each by itself: surfaces that were joined have triangles with the same points.
struct DualMesh {
  std::vector<DualPoint> points;  ///< some of no triangle
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_surface;  ///< of the model
  std::vector<std::uint32_t> corner_point;      ///< per corner of the model
  /// Per line of the model: points in order along it, none twice in a row; a closed line ends at its first point again.
  std::vector<std::vector<std::uint32_t>> line_points;
  std::vector<DualFlaw> flaws;  ///< ascending
};

/// Polygons between the points of cells, triangulated (pellerin2014 §2.7.4). Every corner of the diagram gives the
/// polygon of the points around it; every chain between two cells that ends on lines at both ends gives one of its own;
/// and every surface component with more than two points gives the polygon of its points, which is what makes merging
/// them a choice (§2.7.2 step 3). Where a border between two points of one component leaves a choice of where to
/// change from one to the other, the sharpest angle decides. Triangles of one surface with the same three points cancel
/// each other, or are one. Points are shared between surfaces, so contacts conform.
DualMesh build_dual_polygons(const StructuralModel& model, const RestrictedDiagram& diagram,
                             const CellComponents& components, const ComponentPoints& points);

}  // namespace strataflow
