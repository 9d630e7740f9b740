#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads MEDIT .mesh (ascii). A patch per reference of triangles and quadrilaterals, a region per reference of volume
/// cells in ascending order, lines from edges. Other sections are named by a warning.
/// Fails with: malformed_file (file:line), unsupported (dimension 2).
Result<InputData> read_medit(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
