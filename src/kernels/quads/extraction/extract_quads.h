#pragma once
#include "base/result.h"
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

}  // namespace strataflow
