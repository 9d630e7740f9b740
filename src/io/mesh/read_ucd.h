#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads AVS UCD (ascii .inp), as LaGriT writes it. A patch per material of triangles and quads, a region per material
/// of volume cells in ascending order, lines from line cells; node values become point properties, cell values are
/// named by a warning. Fails with: malformed_file (file:line), unsupported (binary UCD, Abaqus).
Result<InputData> read_ucd(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
