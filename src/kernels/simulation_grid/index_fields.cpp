#include "kernels/simulation_grid/index_fields.h"

namespace strataflow {

std::vector<CellField> index_fields(const HexGrid& hexes, const SimulationGrid& grid) {
  const std::size_t count = hexes.mesh.cell_count();
  std::vector<CellField> fields;
  for (const char* name : {"column", "layer", "i", "j", "k"}) fields.push_back({name, std::vector<double>(count)});
  for (std::size_t hex = 0; hex < count; ++hex) {
    fields[0].values[hex] = hexes.cell_column[hex];
    fields[1].values[hex] = hexes.cell_layer[hex];
  }
  for (std::size_t cell = 0; cell < grid.hex_of_cell.size(); ++cell) {
    if (grid.hex_of_cell[cell] == no_index) continue;
    const auto ijk = grid.grid.indices(cell);
    for (std::size_t axis = 0; axis < 3; ++axis) fields[2 + axis].values[grid.hex_of_cell[cell]] = ijk[axis] + 1.0;
  }
  return fields;
}

}  // namespace strataflow
