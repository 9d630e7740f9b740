#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/extraction/grid_graph.h"
#include "kernels/quads/extraction/grid_map.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// The preimage of the unit grid of a grid-preserving map (coudert2024 S4, S11): quads counter-clockwise, features as
/// chains of their edges. The map is rounded first (grid_map.h), then every decision is exact. Where the boundary is
/// free (half-edges of the boundary without axis), cells that it cuts are left out.
/// Fails with geometry_failed and names the place when a cell is no quad, a feature is no chain of edges, the result is
/// no manifold of the mesh's Euler characteristic, or a point has another valence than `map.valence` says.
Result<QuadMesh> extract_quads(const FeatureMesh& mesh, const CornerMap& map);

/// The same, and where each quad lies in the map.
struct QuadsOnGrid {
  QuadMesh quads;
  GridMap map;
  GridGraph graph;
  std::vector<std::uint32_t> vertex_of;   ///< per point of the quads: its vertex in the graph
  std::vector<std::uint32_t> first_port;  ///< per quad: the port from its first point along its first side
};
Result<QuadsOnGrid> extract_quads_on_grid(const FeatureMesh& mesh, const CornerMap& map);

}  // namespace strataflow
