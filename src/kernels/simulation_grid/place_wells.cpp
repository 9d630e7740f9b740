#include "kernels/simulation_grid/place_wells.h"

#include <algorithm>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {
/// Whether (x, y) lies in a hexahedron's section at its middle level, or on its border.
bool holds(const VolumeMesh& mesh, std::size_t cell, double x, double y) {
  const std::uint32_t* v = &mesh.cell_vertices[mesh.cell_offsets[cell]];
  for (int s = 0; s < 4; ++s) {
    const Vec3 a = 0.5 * (mesh.points[v[s]] + mesh.points[v[s + 4]]);
    const Vec3 b = 0.5 * (mesh.points[v[(s + 1) % 4]] + mesh.points[v[(s + 1) % 4 + 4]]);
    if (!((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) >= 0)) return false;
  }
  return true;
}
}  // namespace

Result<std::vector<SimulationWell>> place_wells(const HexGrid& hexes, const SimulationGrid& grid,
                                                const std::vector<WellPlan>& plans) {
  std::vector<std::uint32_t> cell_of_hex(hexes.mesh.cell_count(), no_index);
  for (std::uint32_t cell = 0; cell < grid.hex_of_cell.size(); ++cell)
    if (grid.hex_of_cell[cell] != no_index) cell_of_hex[grid.hex_of_cell[cell]] = cell;
  std::vector<SimulationWell> wells;
  for (const WellPlan& plan : plans) {
    for (const std::string& region : plan.regions)
      if (std::none_of(grid.rock.begin(), grid.rock.end(), [&](const RegionRock& r) { return r.region == region; }))
        return Failure{FailureCode::invalid_options, "well " + plan.name + ": there is no region " + region,
                       "name one of the model's regions"};
    const auto is_open = [&](std::size_t hex) {
      if (plan.regions.empty()) return true;
      const std::string& own = grid.rock[static_cast<std::size_t>(hexes.mesh.cell_region[hex])].region;
      return std::find(plan.regions.begin(), plan.regions.end(), own) != plan.regions.end();
    };
    const auto is_met = parallel_map(
        hexes.mesh.cell_count(),
        [&](std::size_t hex) {
          return static_cast<char>(!hexes.is_dead[hex] && cell_of_hex[hex] != no_index && is_open(hex) &&
                                   holds(hexes.mesh, hex, plan.x, plan.y));
        },
        1024);
    std::vector<std::uint32_t> hex_of_layer(hexes.layers, no_index);  // on a border: the first
    for (std::uint32_t hex = 0; hex < is_met.size(); ++hex)
      if (is_met[hex] && hex_of_layer[hexes.cell_layer[hex]] == no_index) hex_of_layer[hexes.cell_layer[hex]] = hex;
    SimulationWell well{plan.name, plan.is_injector, plan.rate_t_per_year, plan.pressure_bar, {}};
    for (std::uint32_t k = 0; k < hexes.layers; ++k)
      if (const std::uint32_t hex = hex_of_layer[hexes.layers - 1 - k]; hex != no_index)
        well.cells.push_back(grid.grid.indices(cell_of_hex[hex]));
    if (well.cells.empty())
      return Failure{FailureCode::invalid_options, "well " + plan.name + " meets no cell of its regions",
                     "move it into the model, or name other regions"};
    wells.push_back(std::move(well));
  }
  return wells;
}

}  // namespace strataflow
