#pragma once
#include <filesystem>

#include "base/result.h"
#include "model/structural_model.h"

namespace strataflow {

/// Writes a whole model as a native model file (.sfm) with ids of its own. To keep the ids of an earlier file, use
/// ModelProject. Fails with invalid_input for an inconsistent model, write_failed.
Result<void> write_model_file(const std::filesystem::path& file, const StructuralModel& model);

}  // namespace strataflow
