#pragma once
#include <string>
#include <vector>

#include "model/simulation_grid.h"

namespace strataflow {

/// The GRID section of a simulator's grid: SPECGRID, COORD, ZCORN, ACTNUM, porosity and permeability per region, FAULTS
/// with MULTFLT, PINCH where there are dead cells, NNC. Metres, depth positive down, I and J counter-clockwise seen
/// from above. Coordinates are rounded to 1e-9 of the grid's size. A fault's multiplier stands in MULTFLT for
/// neighbours by index and inside the transmissibility of each NNC across it, as comments in the file say.
std::string write_grdecl(const SimulationGrid& grid);

/// The REGIONS section: FIPNUM and SATNUM, both the region's number from 1.
std::string write_region_numbers(const SimulationGrid& grid);

/// Names that simulators take: at most eight capital letters, digits and underscores, all different.
std::vector<std::string> simulator_names(const std::vector<std::string>& names, char first_letter);

/// How many records the keyword FAULTS has, for FAULTDIM.
std::size_t fault_record_count(const SimulationGrid& grid);

}  // namespace strataflow
