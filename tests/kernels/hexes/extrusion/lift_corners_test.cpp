#include "kernels/hexes/extrusion/lift_corners.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

struct Lifter {
  LayeredSpace space;
  QuadMesh plan;
  PlanEdges edges;
  ExtrudeOptions options;
  explicit Lifter(const ColumnModel& columns, ExtrudeOptions how = {}) : options(how) {
    space = support::upright(support::filled(columns, 100), {2, {}, {}});
    plan = support::plan_of(columns, 100);
    edges = *find_plan_edges(plan, space.model);
  }
};

TEST(LiftCorners, puts_a_point_of_the_plan_straight_above_itself_and_on_its_horizon) {
  const Lifter set(*vertical_faults(0, false));
  const CornerLifter lifter(set.space, set.plan, set.edges, set.options);
  const std::uint32_t p = static_cast<std::uint32_t>(set.plan.points.size() / 2);
  double before = -1;
  for (std::uint32_t level = 0; level <= 8; ++level) {
    const Lift lift = lifter.lift_column(p)[level];
    EXPECT_NEAR(lift.position.x, set.plan.points[p].x, 1e-9);
    EXPECT_NEAR(lift.position.y, set.plan.points[p].y, 1e-9);
    EXPECT_GT(lift.position.z, before);
    before = lift.position.z;
  }
  EXPECT_EQ(before, 400);
  EXPECT_FALSE(lifter.outside_quad());
}

TEST(LiftCorners, lifts_corners_of_both_sides_of_a_fault_to_the_height_of_their_side) {
  const Lifter set(*vertical_faults(1, false));
  const CornerLifter lifter(set.space, set.plan, set.edges, set.options);
  for (const PlanEdge& edge : set.edges.edges) {
    if (edge.faults.empty() || std::abs(set.plan.points[edge.points[0]].y - 600) > 60) continue;
    const std::uint32_t left = 4 * edge.quads[0] + edge.sides[0], right = 4 * edge.quads[1] + edge.sides[1];
    const Lift one = lifter.lift_column_on_fault(left)[4], other = lifter.lift_column_on_fault(right)[4];
    EXPECT_FALSE(one.is_unreached || other.is_unreached);
    EXPECT_NEAR(std::abs(one.position.z - other.position.z), 30, 1);
  }
}

TEST(LiftCorners, lands_on_faults_and_sides_from_a_plan_that_passes_beside_them) {
  Lifter set(*vertical_faults(1, false));
  const double fault_x = 1600 * 5.0 / 12;
  for (Vec3& p : set.plan.points) {
    if (std::abs(p.x - fault_x) < 1e-6) p.x += 5;
    if (p.x == 0) p.x = 4;
  }
  const CornerLifter lifter(set.space, set.plan, set.edges, set.options);
  for (std::uint32_t p = 0; p < set.plan.points.size(); ++p)
    for (const std::uint32_t level : {0u, 3u, 8u}) {
      const std::uint32_t corner = set.edges.wedges[set.edges.first_wedge[p]];
      if (set.edges.is_on_fault[p]) {
        EXPECT_NEAR(lifter.lift_column_on_fault(corner)[level].position.x, fault_x, 1e-9);
      } else if (set.plan.points[p].x == 4) {
        EXPECT_NEAR(lifter.lift_column(p)[level].position.x, 0, 1e-9);
      }
    }
}

TEST(LiftCorners, cannot_reach_a_side_without_a_ball_to_look_in) {
  const Lifter set(*vertical_faults(1, true), {0, false});
  const CornerLifter lifter(set.space, set.plan, set.edges, set.options);
  bool is_unreached = false;
  for (const PlanEdge& edge : set.edges.edges)
    for (std::size_t s = 0; s < 2 && !edge.faults.empty(); ++s)
      is_unreached = is_unreached || lifter.lift_column_on_fault(4 * edge.quads[s] + edge.sides[s])[3].is_unreached;
  EXPECT_TRUE(is_unreached);
}

TEST(LiftCorners, tells_of_a_quad_outside_the_model) {
  Lifter set(*vertical_faults(0, false));
  for (Vec3& p : set.plan.points) p.x += 500;
  EXPECT_TRUE(CornerLifter(set.space, set.plan, set.edges, set.options).outside_quad());
}

}  // namespace
}  // namespace strataflow
