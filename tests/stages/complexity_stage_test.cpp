#include "stages/complexity_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

TEST(ComplexityStage, measures_a_model_and_its_output_survives_the_store) {
  const BuiltModel built = *build_structural_model(support::layered_box({0, 0.3, 0.32, 1}));
  MeasureComplexity stage;
  stage.options.cells = {8};
  StageContext context("complexity", 1);
  const Result<ComplexityReport> report = stage(built, context);
  ASSERT_TRUE(report) << describe(report.failure());
  EXPECT_EQ(report->counts.surfaces, 2u);
  EXPECT_DOUBLE_EQ(report->geometric.edge_length_m, std::sqrt(3.0) / 200);
  EXPECT_TRUE(context.warnings().empty());
  const auto again = unarchived<ComplexityReport>(archived(*report));
  ASSERT_TRUE(again);
  EXPECT_EQ(archived(*again), archived(*report));
}

TEST(ComplexityStage, warns_where_thickness_cannot_be_sampled_as_finely_as_asked) {
  const BuiltModel built = *build_structural_model(support::layered_box({0, 0.5, 1}));
  MeasureComplexity stage;
  stage.options.cells = {1};
  stage.options.edge_length_m = 4e-4;
  StageContext context("complexity", 1);
  ASSERT_TRUE(stage(built, context));
  ASSERT_EQ(context.warnings().size(), 1u);
  EXPECT_EQ(context.warnings()[0].kind, "coarse_thickness");
}

}  // namespace
}  // namespace strataflow
