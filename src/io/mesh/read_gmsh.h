#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads Gmsh .msh 2.x and 4.1, ascii and binary. A patch per elementary surface, its entity the physical group; a
/// region per physical volume (elementary where there is none) in ascending order of tags; lines from curves.
/// Elements of higher order and other sections are named by a warning.
/// Fails with: malformed_file, unsupported (other versions).
Result<InputData> read_gmsh(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
