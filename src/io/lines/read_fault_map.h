#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// A map of faults as text: `B n` and n rows of x y are the outline, each `F n` and n rows one fault (F1, F2 … in their
/// order). Fails with malformed_file naming file:line.
Result<InputData> read_fault_map(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
