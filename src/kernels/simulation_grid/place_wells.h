#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "model/hex_grid.h"
#include "model/simulation_grid.h"

namespace strataflow {

/// A vertical well and what it does; see SimulationWell.
struct WellPlan {
  std::string name;
  double x = 0, y = 0;                    ///< metres, relative to the mesh's local origin
  std::vector<std::string> regions = {};  ///< where it is open; empty: everywhere
  bool is_injector = false;
  double rate_t_per_year = 0;
  double pressure_bar = 0;
};

/// The cells that each well runs through: in every layer the live one whose middle level holds (x, y) — of columns with
/// inclined pillars not always the same. Fails with invalid_options where a well meets no cell of its regions, or names
/// a region without rock.
Result<std::vector<SimulationWell>> place_wells(const HexGrid& hexes, const SimulationGrid& grid,
                                                const std::vector<WellPlan>& plans);

}  // namespace strataflow
