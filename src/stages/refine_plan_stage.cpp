#include "stages/refine_plan_stage.h"

#include "kernels/hexes/cell_states.h"
#include "kernels/hexes/refinement/refine_near_targets.h"
#include "kernels/quads/extraction/check_quads.h"

namespace strataflow {

Result<MeshedQuads> RefinePlan::operator()(const MeshedQuads& plan, const UprightModel& upright, const InputData& input,
                                           StageContext& context) const {
  for (const auto& [target, within_m] : options.refine_within_m)
    if (!options.refine_edge_m.contains(target))
      return Failure{FailureCode::invalid_options, "hex.refine_within_m names '" + target + "', hex.refine_edge_m does not",
                     "give hex.refine_edge_m." + target + " too"};
  std::vector<RefinementTarget> targets;
  for (const auto& [called, edge_m] : options.refine_edge_m) {
    Result<RefinementTarget> target = refinement_target(upright, input, called, edge_m, 0);
    if (!target) return target.failure();
    const auto within = options.refine_within_m.find(called);
    target->within_m = within != options.refine_within_m.end() ? within->second
                       : target->areas.empty()                 ? mean_plan_edge_m(plan.mesh)
                                                               : 0;
    targets.push_back(*std::move(target));
  }
  Result<QuadMesh> refined = refine_near_targets(plan.mesh, targets);
  if (!refined) return refined.failure();
  if (refined->quads.size() == plan.mesh.quads.size())
    context.warn("not_refined", "hex.refine_edge_m asks for edges as long as they are");
  if (const Result<void> sound = check_quads(*refined); !sound) return sound.failure();
  MeshedQuads quads = plan;
  quads.mesh = *std::move(refined);
  quads.quality = measure_quads(quads.mesh);
  if (quads.quality.inverted > 0)
    return Failure{FailureCode::geometry_failed,
                   std::to_string(quads.quality.inverted) + " quads turn over where the plan is refined",
                   "ask for shorter hex.edge_length_m, so that quads there are nearer to squares"};
  return quads;
}

}  // namespace strataflow
