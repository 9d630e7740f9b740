#pragma once
#include <string>

#include "model/simulation_grid.h"

namespace strataflow::support {

/// nx × ny × nz cells of 100 m × 100 m × 10 m, the top at −1000, one region, upright pillars.
inline SimulationGrid regular_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz) {
  SimulationGrid grid;
  CornerPointGrid& points = grid.grid;
  points.size = {nx, ny, nz};
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i) {
      points.pillars.push_back({100.0 * i, 100.0 * j, -1000});
      points.pillars.push_back({100.0 * i, 100.0 * j, -1000 - 10.0 * nz});
    }
  points.corner_z.resize(8 * points.cell_count());
  for (std::uint32_t cell = 0; cell < points.cell_count(); ++cell) {
    const auto ijk = points.indices(cell);
    for (std::uint32_t c = 0; c < 8; ++c)
      points.corner_z[points.corner(ijk, c & 1, c >> 1 & 1, c >> 2)] = -1000 - 10.0 * (ijk[2] + (c >> 2));
    grid.hex_of_cell.push_back(cell);
  }
  points.is_active.assign(points.cell_count(), 1);
  grid.cell_region.assign(points.cell_count(), 0);
  grid.rock = {{"sand", 0.25, 100, 10}};
  grid.report.layout = "native";
  return grid;
}

}  // namespace strataflow::support
