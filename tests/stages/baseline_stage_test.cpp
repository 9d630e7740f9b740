// Pillar grids, stair-step grids and refined plans, from tetrahedra to a simulator's files, stage by stage.
#include "stages/baseline_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "stages/check_validity_stage.h"
#include "stages/draw_stage.h"
#include "stages/extrude_stage.h"
#include "stages/plan_problem_stage.h"
#include "stages/refine_plan_stage.h"
#include "stages/simulation_grid_stage.h"
#include "stages/stratigraphic_function_stage.h"
#include "stages/tetrahedralize_stage.h"
#include "stages/verticalize_stage.h"
#include "support/made.h"

namespace strataflow {
namespace {

using support::made;

const VolumeMesh& dipping() {
  static const VolumeMesh mesh = [] {
    StageContext context("test", 1);
    const BuiltModel built =
        *build_structural_model(*generate_reference_model("dipping-faults", {.resolution_m = 150}));
    TetrahedralizeOptions tets;
    tets.radius_edge_ratio = 1.8;
    return made(Tetrahedralize{tets}(built, *CheckValidity{}(built, context), context));
  }();
  return mesh;
}

const UprightModel& upright() {
  static const UprightModel model = [] {
    StageContext context("test", 1);
    return made(Verticalize{}(dipping(), context));
  }();
  return model;
}

struct Checked {
  CheckedHexes hexes;
  SimulationFiles files;
  std::vector<Warning> warnings;
};

Checked checked(const ExtrudedHexes& extruded, const LayeredSpace& space, const MeshedQuads& plan,
                SimulationGridStageOptions simulation) {
  StageContext context("test", 1);
  const SmoothedHexes smoothed = made(SmoothHexes{{.smoothing_sweeps = 0}}(space, extruded, context));
  EXPECT_EQ(smoothed.hexes.grid.mesh.points, extruded.grid.mesh.points);
  Checked result;
  result.hexes = made(CheckHexes{}(smoothed, space, plan, context));
  result.files = made(MakeSimulationGrid{simulation}(smoothed, result.hexes, space, {}, context));
  result.warnings = context.warnings();
  return result;
}

TEST(BaselineStages, pillars_follow_faults_in_a_native_layout) {
  StageContext context("test", 1);
  const LayeredSpace space = made(FindStratigraphicFunction{{.layers = 2}}(upright(), context));
  const InputData lines = made(TakePlanLines{}(upright(), {}, context));
  const MeshedQuads plan =
      made(CutPillars{}(made(PlanProblem{{.plan = {.edge_length_m = 150}}}(lines, context)), context));
  EXPECT_EQ(plan.quality.interior_irregular, 0u);
  SimulationGridStageOptions simulation;
  simulation.layout = "native";
  simulation.pillar_tolerance_m = std::numeric_limits<double>::max();
  const Checked grid = checked(made(Extrude{}(space, plan, context)), space, plan, simulation);
  EXPECT_EQ(grid.hexes.audit.inverted, 0u);
  EXPECT_LT(grid.hexes.audit.furthest_from_faults_m, 1e-6);
  EXPECT_LT(grid.hexes.audit.furthest_from_horizons_m, 1e-6);
  EXPECT_EQ(grid.files.grid.report.layout, "native");
  EXPECT_EQ(grid.files.grid.report.blocks, 1u);
  EXPECT_EQ(made(DrawPlan{}(plan, context)).pictures.size(), 1u);
}

TEST(BaselineStages, stairs_pass_faults_in_steps_with_upright_pillars) {
  StageContext context("test", 1);
  const UprightModel model = made(TakePlan{}(dipping(), context));
  const LayeredSpace space = made(FindStratigraphicFunction{{.layers = 2}}(model, context));
  const ExtrudedHexes hexes = made(StairStep{{.edge_length_m = 100}}(space, context));
  const MeshedQuads plan = made(TakeHexPlan{}(hexes, context));
  EXPECT_EQ(plan.mesh.quads.size(), 200u);
  SimulationGridStageOptions simulation;
  simulation.layout = "native";
  const Checked grid = checked(hexes, space, plan, simulation);
  EXPECT_EQ(grid.hexes.audit.inverted, 0u);
  EXPECT_GT(grid.hexes.audit.furthest_from_faults_m, 1);
  EXPECT_LT(grid.hexes.audit.furthest_from_faults_m, 100);
  EXPECT_LT(grid.hexes.audit.lateral_deg.mean(), 5);
  EXPECT_EQ(grid.files.grid.report.largest_deviation_m, 0);
  EXPECT_THAT(grid.warnings, testing::Contains(testing::Field(&Warning::kind, "region_volume")));
}

TEST(BaselineStages, stairs_are_valid_at_other_sizes) {
  StageContext context("test", 1);
  const UprightModel model = made(TakePlan{}(dipping(), context));
  const LayeredSpace space = made(FindStratigraphicFunction{{.layers = 3}}(model, context));
  for (const double edge_m : {50.0, 70.0}) {
    const ExtrudedHexes hexes = made(StairStep{{.edge_length_m = edge_m}}(space, context));
    const Checked grid = checked(hexes, space, made(TakeHexPlan{}(hexes, context)), {});
    EXPECT_EQ(grid.hexes.audit.diagnosis.nonconforming_faces.elsewhere, 0u) << edge_m;
  }
}

TEST(BaselineStages, an_entity_that_is_not_there_cannot_be_dropped_from_stairs) {
  StageContext context("test", 1);
  const auto refused = TakePlan{{.drop_alignment = {"F99"}}}(dipping(), context);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.failure().what, testing::HasSubstr("F99"));
}

}  // namespace
}  // namespace strataflow
