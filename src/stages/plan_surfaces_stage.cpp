#include "stages/plan_surfaces_stage.h"

#include <algorithm>

#include "kernels/quads/field/separate_features.h"
#include "kernels/quads/plan/feature_mesh_of_surface.h"

namespace strataflow {

Result<FeatureMesh> PlanSurfaces::operator()(const BuiltModel& built, StageContext&) const {
  const StructuralModel& model = built.model;
  std::vector<std::uint32_t> chosen;
  for (const std::string& wanted : options.surfaces) {
    const std::size_t before = chosen.size();
    for (std::uint32_t s = 0; s < model.surfaces.size(); ++s)
      if (model.entities[model.surfaces[s].entity].name == wanted) chosen.push_back(s);
    if (chosen.size() > before) continue;
    std::string names;
    for (const Entity& entity : model.entities) names += (names.empty() ? "" : ", ") + entity.name;
    return Failure{FailureCode::invalid_options, "quad.surfaces names '" + wanted + "', which the model does not have",
                   "it has " + names};
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  Result<FeatureMesh> mesh = feature_mesh_of_model(model, chosen, options.problem.on_surfaces());
  return mesh ? separate_features(*mesh) : mesh;
}

}  // namespace strataflow
