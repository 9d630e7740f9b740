#include "stages/plan_surfaces_stage.h"

#include <gtest/gtest.h>

#include "stages/build_model_stage.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

BuiltModel layers() {
  InputData input;
  input.surfaces = support::layered_box({0, 10, 25});
  StageContext context;
  return *BuildModel{}(input, context);
}

TEST(PlanSurfacesStage, takes_named_entities_with_the_lines_where_they_meet_others) {
  StageContext context;
  const BuiltModel model = layers();
  std::string inner;  // of the surfaces that part two regions
  for (const Surface& surface : model.model.surfaces)
    if (surface.region_plus != universe && surface.region_minus != universe) inner = model.model.entities[surface.entity].name;
  ASSERT_FALSE(inner.empty());
  PlanSurfacesOptions options;
  options.problem.plan.edge_length_m = 5;
  options.surfaces = {inner};
  const auto mesh = PlanSurfaces{options}(model, context);
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  for (const Vec3& p : mesh->points) EXPECT_EQ(p.z, mesh->points[0].z) << "the horizon alone";
  EXPECT_FALSE(mesh->edges.empty());
  EXPECT_EQ(mesh->corners.size(), 4u);
}

TEST(PlanSurfacesStage, names_what_the_model_does_not_have) {
  StageContext context;
  const auto mesh = PlanSurfaces{{{}, {"H9"}}}(layers(), context);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.failure().code, FailureCode::invalid_options);
  EXPECT_NE(mesh.failure().what.find("'H9'"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
