// From curves to quads, stage by stage.
#include <gtest/gtest.h>

#include "graph/stage_graph.h"
#include "stages/draw_stage.h"
#include "stages/extract_quads_stage.h"
#include "stages/frame_field_stage.h"
#include "stages/plan_problem_stage.h"
#include "stages/quantize_stage.h"
#include "stages/seamless_map_stage.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

/// A square of 100 m with a fault that dies inside it.
InputData square_with_fault() {
  InputData input;
  input.lines = {{"outline", Role::outline, {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}}, true},
                 {"F1", Role::fault, {{0, 52, 0}, {60, 47, 0}}, false}};
  return input;
}

struct Stages {
  PlanProblem problem{{.plan = {.edge_length_m = 10}}};
  ComputeFrameField field;
  SeamlessMap seamless;
  Quantize quantize;
  ExtractQuads extract;
};

struct Outputs {
  FeatureMesh problem;
  Attempt<FieldAndMap> seamless;
  Attempt<GridMapping> grid;
  Result<MeshedQuads> quads;
};

Outputs run(const Stages& stages, const InputData& input) {
  StageContext context("test");
  const Result<FeatureMesh> problem = stages.problem(input, context);
  EXPECT_TRUE(problem) << describe(problem.failure());
  const auto field = stages.field(*problem, context);
  EXPECT_TRUE(field);
  const auto seamless = stages.seamless(*problem, *field, context);
  EXPECT_TRUE(seamless);
  const auto grid = stages.quantize(*problem, *seamless, context);
  EXPECT_TRUE(grid);
  return {*problem, *seamless, *grid, stages.extract(*problem, *grid, context)};
}

TEST(QuadStages, curves_become_chains_of_quad_edges) {
  const Outputs made = run({}, square_with_fault());
  ASSERT_TRUE(made.quads) << describe(made.quads.failure());
  EXPECT_EQ(made.quads->quality.inverted, 0u);
  EXPECT_TRUE(made.quads->missing.empty());
  EXPECT_TRUE(made.quads->why_subdivided.empty());
  EXPECT_NEAR(static_cast<double>(made.quads->mesh.quads.size()), 100, 40);
  double fault_m = 0;
  for (const FeatureEdge& edge : made.quads->mesh.edges)
    if (made.quads->mesh.features[edge.feature].name == "F1")
      fault_m += length(made.quads->mesh.points[edge.a] - made.quads->mesh.points[edge.b]);
  EXPECT_NEAR(fault_m, std::hypot(60, 5), 0.01);
  StageContext context;
  const Result<Pictures> pictures = DrawQuads{}(made.problem, made.seamless, made.grid, *made.quads, context);
  ASSERT_TRUE(pictures);
  EXPECT_EQ(pictures->pictures.size(), 3u);
}

TEST(QuadStages, the_coarse_mesh_laid_over_the_map_gives_the_same_integers) {
  Stages laid;
  laid.quantize.options.transfer = "imprint";
  const Outputs solved = run({}, square_with_fault()), imprinted = run(laid, square_with_fault());
  ASSERT_TRUE(imprinted.quads) << describe(imprinted.quads.failure());
  EXPECT_EQ(imprinted.grid.value.transfer, "imprint");
  EXPECT_EQ(solved.grid.value.transfer, "solve");
  EXPECT_EQ(imprinted.quads->mesh.quads.size(), solved.quads->mesh.quads.size());
}

TEST(QuadStages, surfaces_are_meshed_along_their_sharp_edges) {
  InputData input;
  input.surfaces = support::box({0, 0, 0}, {40, 40, 40});
  const Outputs made = run({}, input);
  ASSERT_TRUE(made.quads) << describe(made.quads.failure());
  EXPECT_EQ(made.quads->quality.inverted, 0u);
  EXPECT_EQ(made.quads->quality.interior_irregular, 8u) << "the corners of the box";
}

TEST(QuadStages, a_failure_goes_down_to_the_fallback_where_it_is_asked_for) {
  StageContext context("test");
  const Result<FeatureMesh> problem = Stages().problem(square_with_fault(), context);
  ASSERT_TRUE(problem);
  const Attempt<GridMapping> torn{{}, "triangles stay folded"};
  ExtractQuads strict, kind;
  kind.options.fallback.fallback = "subdivide";
  const Result<MeshedQuads> quads = kind(*problem, torn, context);
  ASSERT_TRUE(quads) << describe(quads.failure());
  EXPECT_EQ(quads->mesh.quads.size(), 3 * problem->triangles.size());
  EXPECT_EQ(quads->why_subdivided, "triangles stay folded");
  EXPECT_EQ(quads->mesh.changes.back().kind, "subdivided");
  ASSERT_EQ(context.warnings().size(), 1u);

  Attempt<FrameFieldResult> no_field{{}, "no room"};
  const auto seamless = SeamlessMap{}(*problem, no_field, context);
  ASSERT_TRUE(seamless);
  EXPECT_EQ(seamless->why_not, "no room");
}

TEST(QuadStages, an_input_without_curves_or_surfaces_is_refused) {
  StageContext context("test");
  EXPECT_FALSE(PlanProblem{}(InputData{}, context));
}

}  // namespace
}  // namespace strataflow
