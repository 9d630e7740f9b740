#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads STL, ascii (a patch per solid) or binary (one patch; told by 84 + 50 n bytes, not by the word solid).
/// Three points a facet, as the file has them: equal points are not merged. Normals are not used: the order of the
/// points gives the side. Fails with malformed_file.
Result<InputData> read_stl(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
