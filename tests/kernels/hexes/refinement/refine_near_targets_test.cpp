#include "kernels/hexes/refinement/refine_near_targets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/archive.h"
#include "kernels/hexes/tet_models.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

QuadMesh squares(std::uint32_t side, double edge_m) {
  QuadMesh plan;
  for (std::uint32_t j = 0; j <= side; ++j)
    for (std::uint32_t i = 0; i <= side; ++i) plan.points.push_back({edge_m * i, edge_m * j, 0});
  const auto point = [&](std::uint32_t i, std::uint32_t j) { return i + (side + 1) * j; };
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i)
      plan.quads.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
  return plan;
}

/// The mean edge of the quad that holds a point.
double edge_at(const QuadMesh& plan, double x, double y) {
  for (const auto& q : plan.quads) {
    bool is_inside = true;
    double around = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &a = plan.points[q[k]], &b = plan.points[q[(k + 1) % 4]];
      is_inside = is_inside && (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) >= 0;
      around += length(b - a);
    }
    if (is_inside) return around / 4;
  }
  return 0;
}

QuadMesh refined(const QuadMesh& plan, const std::vector<RefinementTarget>& targets) {
  Result<QuadMesh> result = refine_near_targets(plan, targets);
  EXPECT_TRUE(result) << describe(result.failure());
  if (!result) return {};
  EXPECT_TRUE(check_quads(*result));
  EXPECT_EQ(measure_quads(*result).inverted, 0u);
  return *std::move(result);
}

RefinementTarget point_target(double x, double y, double edge_m, double within_m) {
  return {"P", edge_m, within_m, {{Vec3{x, y, 0}, Vec3{x, y, 0}}}, {}};
}

TEST(RefineNearTargets, comes_as_near_as_thirds_can) {
  const QuadMesh plan = squares(10, 90);
  EXPECT_NEAR(edge_at(refined(plan, {point_target(455, 455, 30, 60)}), 455, 455), 30, 1e-9);
  EXPECT_NEAR(edge_at(refined(plan, {point_target(455, 455, 10, 60)}), 455, 455), 10, 1e-9);
  EXPECT_NEAR(edge_at(refined(plan, {point_target(455, 455, 40, 60)}), 455, 455), 30, 1e-9);
  EXPECT_EQ(refined(plan, {point_target(455, 455, 60, 60)}).quads.size(), plan.quads.size());
}

TEST(RefineNearTargets, leaves_what_is_far_as_it_is) {
  const QuadMesh plan = refined(squares(10, 90), {point_target(455, 455, 10, 30)});
  EXPECT_NEAR(edge_at(plan, 20, 20), 90, 1e-9);
  EXPECT_LT(plan.quads.size(), 500u);
  ASSERT_EQ(plan.changes.size(), 1u);
  EXPECT_EQ(plan.changes[0].kind, "refined_plan");
}

TEST(RefineNearTargets, follows_segments_and_areas) {
  RefinementTarget line{"L", 30, 10, {{Vec3{100, 450, 0}, Vec3{800, 455, 0}}}, {}};
  const QuadMesh along = refined(squares(10, 90), {line});
  for (const double x : {110.0, 400.0, 790.0}) EXPECT_NEAR(edge_at(along, x, 455), 30, 10) << x;
  EXPECT_NEAR(edge_at(along, 450, 100), 90, 1e-9);
  RefinementTarget area{"R", 30, 0, {}, {{Vec3{0, 0, 0}, Vec3{460, 0, 0}, Vec3{0, 460, 0}}}};
  const QuadMesh under = refined(squares(10, 90), {area});
  EXPECT_NEAR(edge_at(under, 45, 45), 30, 1e-9);
  EXPECT_NEAR(edge_at(under, 850, 850), 90, 1e-9);
}

TEST(RefineNearTargets, is_the_same_on_every_schedule) {
  const QuadMesh plan = squares(12, 90);
  const std::vector<std::byte> expected = archived(refined(plan, {point_target(300, 410, 10, 100)}));
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(archived(refined(plan, {point_target(300, 410, 10, 100)})), expected) << schedule;
  });
}

TEST(RefineNearTargets, refuses_more_quads_than_it_can_hold) {
  const Result<QuadMesh> refused = refine_near_targets(squares(700, 1), {point_target(350, 350, 0.3, 1000)});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().code, FailureCode::geometry_failed);
}

TEST(RefinementTarget, is_found_by_the_name_of_a_well_a_fault_or_a_region) {
  const auto columns = vertical_faults(1, false);
  const VolumeMesh mesh = support::filled(*columns, 130);
  const Result<UprightModel> model = make_upright(mesh);
  ASSERT_TRUE(model);
  InputData input;
  input.lines = {{"W", Role::well, {{300, 300, 400}, {500, 300, 0}}, false}};
  input.point_sets = {{"spots", Role::points, {{100, 100, 0}, {200, 200, 0}}, {}}, {"far", Role::points, {{1e6, 0, 0}}, {}}};
  const auto target = [&](const std::string& name) { return refinement_target(*model, input, name, 10, 20); };
  EXPECT_EQ(target("W")->segments.size(), 1u);  // where it meets the top
  EXPECT_EQ(target("spots")->segments.size(), 2u);
  double trace_m = 0;
  const auto fault = target("F1");
  for (const auto& segment : fault->segments) trace_m += length(segment[1] - segment[0]);
  EXPECT_NEAR(trace_m, 1200, 1e-6);
  const std::string region = model->model.region_names.front();
  EXPECT_GT(target(region)->areas.size(), 2u);
  const auto unknown = target("nothing");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.failure().code, FailureCode::invalid_options);
  EXPECT_THAT(unknown.failure().what, testing::HasSubstr("nothing"));
  EXPECT_THAT(target("far").failure().what, testing::HasSubstr("beside the model"));
}

}  // namespace
}  // namespace strataflow
