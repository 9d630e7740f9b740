#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads OFF in its ascii variants (OFF, COFF, NOFF, STOFF …); only positions and polygons are used. One patch.
/// Fails with: malformed_file (file:line), unsupported (binary OFF, 4-D).
Result<InputData> read_off(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
