#pragma once
#include <filesystem>

#include "base/result.h"
#include "model/structural_model.h"

namespace strataflow {

/// Reads the whole model of a native model file (.sfm). Fails with unreadable_file, malformed_file (naming the section
/// and the id), unsupported. `triangle_surface`, `point_line` and `point_corner` follow from the rest.
Result<StructuralModel> read_model_file(const std::filesystem::path& file);

}  // namespace strataflow
