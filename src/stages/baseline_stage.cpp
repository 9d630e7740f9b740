#include "stages/baseline_stage.h"

#include "kernels/hexes/baselines/pillar_plan.h"
#include "kernels/hexes/baselines/stair_step_hexes.h"
#include "model/box3.h"

namespace strataflow {

namespace {

MeshedQuads measured(QuadMesh mesh) {
  MeshedQuads quads;
  quads.mesh = std::move(mesh);
  quads.quality = measure_quads(quads.mesh);
  quads.scaled_jacobian_before = quads.quality.scaled_jacobian.minimum;
  return quads;
}

}  // namespace

Result<MeshedQuads> CutPillars::operator()(const FeatureMesh& problem, StageContext&) const {
  Result<QuadMesh> plan = pillar_plan(problem);
  if (!plan) return plan.failure();
  return measured(*std::move(plan));
}

Result<UprightModel> TakePlan::operator()(const VolumeMesh& tets, StageContext&) const {
  return take_model(tets, options.drop_alignment);
}

Result<ExtrudedHexes> StairStep::operator()(const LayeredSpace& space, StageContext&) const {
  Box3 box;
  for (const Vec3& p : space.model.points) box.take(Vec3{p.x, p.y, 0});
  return stair_step_hexes(space, options.edge_length_m > 0 ? options.edge_length_m : 0.01 * box.diagonal_m());
}

Result<MeshedQuads> TakeHexPlan::operator()(const ExtrudedHexes& hexes, StageContext&) const {
  return measured(hexes.grid.plan);
}

}  // namespace strataflow
