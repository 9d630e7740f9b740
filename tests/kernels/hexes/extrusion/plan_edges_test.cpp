#include "kernels/hexes/extrusion/plan_edges.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// Two squares side by side, F1 between them.
QuadMesh two_squares() {
  QuadMesh plan;
  plan.points = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 1, 0}};
  plan.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  plan.features = {{"F1", Role::fault, 0, -1}};
  plan.edges = {{1, 4, 0}};
  return plan;
}
LabelledTets model_with(std::vector<Entity> entities) {
  LabelledTets model;
  model.entities = std::move(entities);
  return model;
}

TEST(PlanEdges, knows_the_quads_beside_every_edge_and_the_faults_above_it) {
  const Result<PlanEdges> found =
      find_plan_edges(two_squares(), model_with({{"H", Role::horizon}, {"F1", Role::fault}}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->edges.size(), 7u);
  const PlanEdge& middle = found->edges[found->edge_of[4 * 0 + 1]];
  EXPECT_EQ(middle.quads, (std::array<std::uint32_t, 2>{0, 1}));
  EXPECT_EQ(middle.sides, (std::array<std::uint32_t, 2>{1, 3}));
  EXPECT_EQ(middle.faults, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(found->is_on_fault, (std::vector<char>{0, 1, 0, 0, 1, 0}));
  EXPECT_EQ(found->wedge_count(1), 2u);
  EXPECT_EQ(found->wedges[found->first_wedge[1] + 1], 4u);
  EXPECT_EQ(found->local_edge_m[2], 1);
}

TEST(PlanEdges, leaves_strips_uncut) {
  QuadMesh plan = two_squares();
  plan.features[0].strip_quads = 1;
  const Result<PlanEdges> found = find_plan_edges(plan, model_with({{"F1", Role::fault}}));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->edges[found->edge_of[1]].faults.empty());
}

TEST(PlanEdges, refuses_plans_that_are_not_of_this_model) {
  const LabelledTets model = model_with({{"F1", Role::fault}});
  EXPECT_FALSE(find_plan_edges(two_squares(), model_with({{"F2", Role::fault}})));
  QuadMesh plan = two_squares();
  plan.edges[0] = {0, 4, 0};  // a diagonal
  EXPECT_FALSE(find_plan_edges(plan, model));
  plan = two_squares();
  plan.edges[0].feature = 7;
  EXPECT_FALSE(find_plan_edges(plan, model));
  plan = two_squares();
  plan.quads.push_back({1, 4, 3, 0});
  EXPECT_FALSE(find_plan_edges(plan, model));
  plan.quads.back() = {1, 1, 3, 0};
  EXPECT_FALSE(find_plan_edges(plan, model));
}

}  // namespace
}  // namespace strataflow
