#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/corner_point_grid.h"
#include "model/input_data.h"

namespace strataflow {

/// A grid of a ROFF file and the zone of each of its layers, from the top; no zones if the file names none.
struct RoffGrid {
  CornerPointGrid grid;
  std::vector<std::int32_t> layer_zone;
};

/// Reads the grid of a ROFF file (RMS), binary or ascii: dimensions, translate, scale, cornerLines, zvalues, active and
/// subgrids; properties are passed over. z is up in the result. Fails with malformed_file.
Result<RoffGrid> read_roff_grid(std::string_view bytes, const std::string& file_name);

/// The same as hexahedra, one region per zone; see hexahedra_of.
Result<InputData> read_roff(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
