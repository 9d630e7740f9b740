#include "kernels/hexes/baselines/pillar_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "base/archive.h"
#include "kernels/hexes/baselines/plan_problems.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/simulation_grid/plan_blocks.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::plan_problem;

QuadMesh cut(const FeatureMesh& problem) {
  Result<QuadMesh> plan = pillar_plan(problem);
  EXPECT_TRUE(plan) << describe(plan.failure());
  if (!plan) return {};
  EXPECT_TRUE(check_quads(*plan));
  EXPECT_EQ(measure_quads(*plan).inverted, 0u);
  EXPECT_EQ(measure_quads(*plan).interior_irregular, 0u);
  return *std::move(plan);
}

/// The length of the edges on a fault, and the furthest they lie from the line through its ends.
struct Followed {
  double length_m = 0, furthest_m = 0;
};
Followed followed(const QuadMesh& plan, const std::string& fault, const Vec3& from, const Vec3& to) {
  Followed found;
  const Vec3 along = (1 / length(to - from)) * (to - from);
  for (const FeatureEdge& edge : plan.edges) {
    if (plan.features[edge.feature].name != fault) continue;
    found.length_m += length(plan.points[edge.b] - plan.points[edge.a]);
    for (const std::uint32_t p : {edge.a, edge.b})
      found.furthest_m = std::max(found.furthest_m, std::abs(cross(along, plan.points[p] - from).z));
  }
  return found;
}

TEST(PillarPlan, cuts_a_rectangle_into_squares) {
  const QuadMesh plan = cut(plan_problem({}));
  EXPECT_EQ(plan.quads.size(), 80u);
  for (const Vec3& p : plan.points) {
    EXPECT_NEAR(p.x, 100 * std::round(p.x / 100), 1e-6);
    EXPECT_NEAR(p.y, 100 * std::round(p.y / 100), 1e-6);
  }
}

TEST(PillarPlan, runs_rows_along_faults_that_lean_against_the_axes) {
  const QuadMesh plan = cut(plan_problem({{{350, 0, 0}, {520, 800, 0}}, {{0, 430, 0}, {1000, 370, 0}}}));
  const Followed first = followed(plan, "F1", {350, 0, 0}, {520, 800, 0});
  EXPECT_NEAR(first.length_m, std::hypot(170, 800), 1e-6);
  EXPECT_LT(first.furthest_m, 1e-6);
  const Followed second = followed(plan, "F2", {0, 430, 0}, {1000, 370, 0});
  EXPECT_NEAR(second.length_m, std::hypot(1000, 60), 1e-6);
  EXPECT_LT(second.furthest_m, 1e-6);
}

TEST(PillarPlan, ends_a_dying_fault_at_the_next_pillar) {
  const QuadMesh plan = cut(plan_problem({{{430, 210, 0}, {470, 630, 0}}}));
  const Followed found = followed(plan, "F1", {430, 210, 0}, {470, 630, 0});
  EXPECT_GE(found.length_m, std::hypot(40, 420) - 1e-6);
  EXPECT_LE(found.length_m, std::hypot(40, 420) + 250);
}

TEST(PillarPlan, puts_two_faults_that_end_opposite_each_other_into_one_plane) {
  const QuadMesh apart = cut(plan_problem({{{400, 0, 0}, {400, 300, 0}}, {{620, 500, 0}, {620, 800, 0}}}));
  const QuadMesh joined = cut(plan_problem({{{400, 0, 0}, {400, 300, 0}}, {{430, 500, 0}, {430, 800, 0}}}));
  EXPECT_EQ(apart.quads.size(), 80u);
  EXPECT_EQ(joined.quads.size(), 80u);  // no column 30 m wide
  EXPECT_LT(followed(joined, "F1", {400, 0, 0}, {400, 300, 0}).furthest_m, 60);
}

TEST(PillarPlan, has_the_native_layout) {
  const QuadMesh plan = cut(plan_problem({{{350, 0, 0}, {520, 800, 0}}}));
  EXPECT_TRUE(native_block(plan, *opposite_half_edges(plan)));
}

TEST(PillarPlan, is_the_same_on_every_schedule) {
  const FeatureMesh problem = plan_problem({{{350, 0, 0}, {520, 800, 0}}, {{0, 430, 0}, {1000, 370, 0}}});
  std::vector<std::byte> first;
  support::on_every_schedule([&](const char* schedule) {
    const Result<QuadMesh> plan = pillar_plan(problem);
    ASSERT_TRUE(plan);
    const std::vector<std::byte> bytes = archived(*plan);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << schedule;
  });
}

TEST(PillarPlan, passes_on_why_a_fault_does_not_fit) {
  const Result<QuadMesh> refused = pillar_plan(plan_problem({{{0, 400, 0}, {400, 800, 0}}}));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.failure().what, testing::HasSubstr("F1"));
  EXPECT_THAT(refused.failure().remedy, testing::HasSubstr("drop_alignment"));
}

}  // namespace
}  // namespace strataflow
