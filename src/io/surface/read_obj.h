#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads Wavefront OBJ: v, f (any polygon, `a/b/c`, negative indices), l, g, o. A patch per group; its entity is the
/// object (`o`) it stands in, or the group itself. A file without groups is one patch named after the file. Normals,
/// texture coordinates and free-form statements are named by a warning. Fails with malformed_file (file:line).
Result<InputData> read_obj(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
