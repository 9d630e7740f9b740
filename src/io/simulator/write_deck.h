#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "model/simulation_grid.h"

namespace strataflow {

enum class DeckFluid {
  co2_brine,  ///< CO2STORE: brine in the place of oil, gas dissolves
  gas_water   ///< an immiscible stand-in for simulators without CO2STORE: water, and a gas like CO2
};

/// The defaults are the flow part of coudert2024 table 2.1.
struct DeckOptions {
  std::string title = "strataflow";
  DeckFluid fluid = DeckFluid::co2_brine;
  double initial_pressure_bar = 40;            ///< at the highest cell, > 0
  double temperature_c = 40;                   ///< everywhere, 0 … 200
  double rock_compressibility_per_bar = 1e-5;  ///< ≥ 0
  double years = 20;                           ///< > 0
};

/// A complete deck (RUNSPEC … SCHEDULE, METRIC) that includes `grid_file`, the text of write_grdecl, and
/// `regions_file`, that of write_region_numbers. All rock starts full of water; every region has the same relative
/// permeabilities (Corey, exponent 2), in a table of its own. Fails with invalid_options (an option out of its domain,
/// a well without cells) and invalid_input (a grid without active cells).
Result<std::string> write_deck(const SimulationGrid& grid, const std::vector<SimulationWell>& wells,
                               const std::string& grid_file, const std::string& regions_file,
                               const DeckOptions& options = {});

}  // namespace strataflow
