#pragma once
#include <optional>
#include <vector>

#include "base/result.h"
#include "kernels/simulation_grid/place_columns.h"
#include "model/hex_grid.h"
#include "model/simulation_grid.h"

namespace strataflow {

struct SimulationGridOptions {
  GridLayout layout = GridLayout::automatic;
  /// How far a corner may lie from its straight pillar before its column is split in K, metres, > 0. Nothing: 1 % of
  /// the mean edge of the plan.
  std::optional<double> pillar_tolerance_m;
  std::uint64_t most_places = 20'000'000;  ///< of the index box
};

/// The corner-point grid of hexahedra in layers, with non-neighbour connections for all contacts that indices do not
/// tell. `rock` is per region of the mesh (cell_region counts from 0). Transmissibilities are those of two-point flux
/// as simulators define them (NEWTRAN): per cell k A·d / d², A the vector area in common and d from the middle of the
/// cell's corners to that of its side's; halves in series, times the fault's multiplier. Dead cells are inactive; what
/// lies above and below them touches (PINCH). Faults of the mesh that `faults` does not name have multiplier 1.
///
/// Fails with invalid_options (a tolerance, rock or multiplier out of its domain, an unknown fault), invalid_input (a
/// damaged grid, a region without rock) and unsupported (layout native where the plan allows none, or whose pillars
/// are not straight within the tolerance; more than 2³¹ places).
Result<SimulationGrid> build_simulation_grid(const HexGrid& hexes, const std::vector<RegionRock>& rock,
                                             const std::vector<FaultTransmissibility>& faults,
                                             const SimulationGridOptions& options = {});

}  // namespace strataflow
