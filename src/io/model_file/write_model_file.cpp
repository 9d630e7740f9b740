#include "io/model_file/write_model_file.h"

#include "io/model_file/model_project.h"

namespace strataflow {

Result<void> write_model_file(const std::filesystem::path& file, const StructuralModel& model) {
  ModelProject project;
  ModelIds ids;
  if (auto stored = project.set_model(model, ids); !stored) return stored;
  return project.save(file);
}

}  // namespace strataflow
