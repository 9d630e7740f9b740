#pragma once
#include <functional>
#include <vector>

#include "kernels/hexes/extrusion/plan_edges.h"
#include "kernels/hexes/layered_space.h"
#include "model/hex_grid.h"

namespace strataflow {

/// What a grid's facets are made from.
struct HexFacetSource {
  const LayeredSpace& space;
  const PlanEdges& edges;
  std::function<bool(std::uint32_t edge, std::uint32_t layer)> is_fault_face;
  double edge_m = 1;  ///< mean of the plan
};

/// The faces of cells on horizons, top, bottom, sides and faults (coudert2024 S15): levels from below, each quad by
/// quad, then edge by edge of the plan. Of levels that coincide over a quad, the lowest and the highest carry the
/// surface that is there; a fault face with an offset has a facet for each side. Cells are column · layers + layer;
/// needs `is_dead`.
std::vector<MeshFacet> make_hex_facets(const HexGrid& grid, const HexFacetSource& source);

}  // namespace strataflow
