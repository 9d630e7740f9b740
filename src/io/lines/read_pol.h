#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Lines as rows of x y z; a row of three times 999 ends one (IRAP's .pol: outlines, fault sticks). All have the
/// file's name; one that ends where it begins is closed. Fails with malformed_file naming file:line.
Result<InputData> read_pol(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
