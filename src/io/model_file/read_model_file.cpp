#include "io/model_file/read_model_file.h"

#include "io/model_file/model_project.h"

namespace strataflow {

Result<StructuralModel> read_model_file(const std::filesystem::path& file) {
  auto project = ModelProject::open(file);
  if (!project) return project.failure();
  if (auto loaded = project->load_all(); !loaded) return loaded.failure();
  return project->model();
}

}  // namespace strataflow
