#include "stages/plan_problem_stage.h"

#include "kernels/quads/field/separate_features.h"
#include "kernels/quads/plan/feature_mesh_of_surface.h"
#include "kernels/quads/plan/plan_mesh.h"

namespace strataflow {

Result<FeatureMesh> PlanProblem::operator()(const InputData& input, StageContext& context) const {
  Result<FeatureMesh> mesh = [&] {
    if (input.surfaces.triangles.empty())
      return plan_mesh(input.lines, input.point_sets, input.surfaces.local_origin, options.plan);
    SurfaceFeatureOptions surface;
    surface.edge_length_m = options.plan.edge_length_m;
    surface.corner_deg = options.plan.corner_deg;
    surface.feature_deg = options.feature_deg;
    surface.by_label = options.by_label;
    if (!input.lines.empty())
      context.warn("ignored_lines", "quads are made on the surfaces of the input; its " +
                                        std::to_string(input.lines.size()) + " lines are ignored");
    return feature_mesh_of_surface(input.surfaces, surface);
  }();
  if (!mesh) return mesh;
  return separate_features(*mesh);
}

}  // namespace strataflow
