#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"
#include "model/simulation_grid.h"

namespace strataflow {

/// Reads the grid of a GRDECL file: SPECGRID or DIMENS, COORD, ZCORN, ACTNUM (all active if absent), MAPAXES, GRIDUNIT
/// (metres unless FEET or CM) and NNC with its transmissibilities. Other keywords are passed over. z is up in the
/// result. Fails with malformed_file, and unsupported for INCLUDE.
Result<SimulationGrid> read_corner_points(std::string_view text, const std::string& file_name);

/// The same as hexahedra, for a table of formats; see hexahedra_of.
Result<InputData> read_grdecl(std::string_view text, const std::string& file_name);

}  // namespace strataflow
