#include "stages/plan_problem_stage.h"

#include "kernels/quads/field/separate_features.h"
#include "kernels/quads/plan/plan_mesh.h"

namespace strataflow {

Result<FeatureMesh> PlanProblem::operator()(const InputData& input, StageContext& context) const {
  Result<FeatureMesh> mesh = [&] {
    if (input.surfaces.triangles.empty())
      return plan_mesh(input.lines, input.point_sets, input.surfaces.local_origin, options.plan);
    if (!input.lines.empty())
      context.warn("ignored_lines", "quads are made on the surfaces of the input; its " +
                                        std::to_string(input.lines.size()) + " lines are ignored");
    return feature_mesh_of_surface(input.surfaces, options.on_surfaces());
  }();
  if (!mesh) return mesh;
  return separate_features(*mesh);
}

}  // namespace strataflow
