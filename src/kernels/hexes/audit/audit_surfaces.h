#pragma once
#include <vector>

#include "kernels/hexes/audit/hex_audit.h"
#include "kernels/hexes/labelled_tets.h"
#include "kernels/hexes/live_cells.h"

namespace strataflow {

/// Distances of the facets on every surface of the model from its triangles (coudert2024 R23, R24), one entry per
/// entity that has facets in the model or in the grid, by entity. Areas are those of the live cells, `live`.
std::vector<SurfaceAudit> audit_surfaces(const HexGrid& grid, const LiveCells& live, const LabelledTets& model);

/// Volumes of regions, and what they may differ by.
std::vector<RegionVolumeAudit> audit_regions(const HexGrid& grid, const LabelledTets& model);

/// Per vertex, whether it is one of a facet on a fault.
std::vector<char> vertices_on_faults(const VolumeMesh& mesh);

}  // namespace strataflow
