#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads PLY: ascii, binary little and big endian, lists of any types. One patch; numbers of vertices other than x, y,
/// z become point properties. Other elements and face properties are named by a warning. Fails with malformed_file
/// (file:line, or the byte in binary data).
Result<InputData> read_ply(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
