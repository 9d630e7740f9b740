#pragma once
#include <array>

#include "kernels/hexes/audit/hex_audit.h"
#include "kernels/hexes/live_cells.h"

namespace strataflow {

/// Looks at the live cells of a grid as GEOS's mesh-doctor would.
CellDiagnosis diagnose_cells(const HexGrid& grid, const LiveCells& live);

/// Whether some edge of a hexahedron passes through a face that it does not touch, or two opposite edges of a face
/// cross; exact, faces as two triangles.
bool is_self_intersecting(const std::array<Vec3, 8>& corners);

}  // namespace strataflow
