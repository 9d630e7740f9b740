#pragma once
#include "base/result.h"
#include "kernels/hexes/audit/hex_audit.h"
#include "kernels/hexes/labelled_tets.h"
#include "model/hex_grid.h"

namespace strataflow {

/// Holds hexahedra in layers, wherever they come from, against the model they should fill: cells, orthogonality, the
/// way they follow horizons and faults, volumes of regions, valences, and what a finite-element code would object to
/// (coudert2024 R20–R25, S1). Nothing is taken over from the extrusion but the grid itself. The same on every
/// schedule. Fails with invalid_input when the grid is damaged or has another local origin than the model.
Result<HexAudit> audit_hexes(const HexGrid& grid, const LabelledTets& model);

}  // namespace strataflow
