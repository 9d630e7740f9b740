#include "stages/refine_plan_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/hexes/cell_states.h"

namespace strataflow {
namespace {

/// 10 × 10 squares of 100 m, and a model of which the fault F1 alone is known.
struct Setting {
  MeshedQuads plan;
  UprightModel model;
};
Setting squares() {
  Setting setting;
  for (std::uint32_t j = 0; j <= 10; ++j)
    for (std::uint32_t i = 0; i <= 10; ++i) setting.plan.mesh.points.push_back({100.0 * i, 100.0 * j, 0});
  for (std::uint32_t j = 0; j < 10; ++j)
    for (std::uint32_t i = 0; i < 10; ++i) {
      const std::uint32_t p = i + 11 * j;
      setting.plan.mesh.quads.push_back({p, p + 1, p + 12, p + 11});
    }
  setting.model.lines = {{"F1", Role::fault, {{500, 0, 0}, {500, 1000, 0}}, false}};
  return setting;
}

TEST(RefinePlan, cuts_quads_within_an_edge_of_a_fault_unless_told_otherwise) {
  const Setting setting = squares();
  StageContext context("test", 1);
  const Result<MeshedQuads> near = RefinePlan{{{{"F1", 33}}, {{"F1", 0}}}}(setting.plan, setting.model, {}, context);
  ASSERT_TRUE(near) << describe(near.failure());
  const Result<MeshedQuads> wider = RefinePlan{{{{"F1", 33}}, {}}}(setting.plan, setting.model, {}, context);
  ASSERT_TRUE(wider) << describe(wider.failure());
  EXPECT_GT(near->mesh.quads.size(), 20u * 9);
  EXPECT_GT(wider->mesh.quads.size(), near->mesh.quads.size() + 2 * 10 * 6);
  EXPECT_EQ(near->quality.inverted, 0u);
  EXPECT_LT(mean_plan_edge_m(near->mesh), 60);
  EXPECT_TRUE(context.warnings().empty());
}

TEST(RefinePlan, warns_where_edges_are_short_enough_and_refuses_what_it_does_not_know) {
  const Setting setting = squares();
  StageContext context("test", 1);
  ASSERT_TRUE((RefinePlan{{{{"F1", 90}}, {}}}(setting.plan, setting.model, {}, context)));
  ASSERT_EQ(context.warnings().size(), 1u);
  EXPECT_EQ(context.warnings()[0].kind, "not_refined");
  const auto unknown = RefinePlan{{{{"W9", 20}}, {}}}(setting.plan, setting.model, {}, context);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.failure().what, testing::HasSubstr("W9"));
  const auto half = RefinePlan{{{{"F1", 20}}, {{"F2", 5}}}}(setting.plan, setting.model, {}, context);
  ASSERT_FALSE(half);
  EXPECT_THAT(half.failure().what, testing::HasSubstr("F2"));
}

}  // namespace
}  // namespace strataflow
