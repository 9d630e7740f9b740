#pragma once
#include <vector>

#include "model/cell_field.h"
#include "model/hex_grid.h"
#include "model/simulation_grid.h"

namespace strataflow {

/// Values per hexahedron for a VTU file: column and layer of the grid, and I, J, K of its place, from 1 as in decks.
/// Named column, layer, i, j, k.
std::vector<CellField> index_fields(const HexGrid& hexes, const SimulationGrid& grid);

}  // namespace strataflow
