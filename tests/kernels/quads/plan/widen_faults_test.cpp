#include "kernels/quads/plan/widen_faults.h"

#include <gtest/gtest.h>

#include "kernels/quads/plan/plan_samples.h"

namespace strataflow {
namespace {

using namespace plan_samples;

Result<FeatureMesh> widened(std::vector<Polyline> lines, std::map<std::string, double> thickness_m) {
  lines.insert(lines.begin(), square(100));
  PlanOptions options = edge(10);
  options.fault_thickness_m = std::move(thickness_m);
  return plan_mesh(lines, {}, {}, options);
}

TEST(WidenFaults, a_dying_fault_becomes_a_closed_strip) {
  const auto mesh = widened({fault("a", {{20, 50, 0}, {80, 50, 0}})}, {{"a", 4}});
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_NEAR(feature_length(*mesh, "a left"), 60, 1e-9);
  EXPECT_NEAR(feature_length(*mesh, "a right"), 60, 1e-9);
  EXPECT_NEAR(feature_length(*mesh, "a end"), 8, 1e-9);
  EXPECT_EQ(feature_length(*mesh, "a"), 0);
  const std::uint32_t left = feature_named(mesh->features, "a left");
  EXPECT_EQ(mesh->features[left].strip_quads, 1u);
  EXPECT_EQ(mesh->features[static_cast<std::size_t>(mesh->features[left].strip_of)].name, "a right");
  for (const Vec3& p : {Vec3{20, 52, 0}, Vec3{20, 48, 0}, Vec3{80, 52, 0}, Vec3{80, 48, 0}})
    EXPECT_TRUE(has_corner_at(*mesh, p));
}

TEST(WidenFaults, a_strip_reaches_the_curve_its_trace_ends_on) {
  const auto mesh = widened({fault("a", {{20, 50, 0}, {99.5, 70, 0}})}, {{"a", 4}});
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  int at_side = 0;
  for (const std::uint32_t c : mesh->corners)
    at_side += mesh->points[c].x > 100 - 1e-9 && mesh->points[c].y > 60 && mesh->points[c].y < 80;
  EXPECT_EQ(at_side, 2);
  EXPECT_NEAR(feature_length(*mesh, "a end"), 4, 1e-9);
}

TEST(WidenFaults, curves_end_on_the_side_of_a_strip_or_cross_it) {
  const auto mesh = widened({fault("a", {{20, 50, 0}, {80, 50, 0}}), fault("b", {{40, 50, 0}, {40, 90, 0}}),
                             fault("c", {{60, 20, 0}, {60, 80, 0}})},
                            {{"a", 4}});
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_NEAR(feature_length(*mesh, "b"), 38, 1e-9);
  EXPECT_NEAR(feature_length(*mesh, "c"), 60, 1e-9);
  for (const Vec3& p : {Vec3{40, 52, 0}, Vec3{60, 52, 0}, Vec3{60, 48, 0}}) EXPECT_TRUE(has_corner_at(*mesh, p)) << p.x;
  EXPECT_FALSE(has_corner_at(*mesh, {40, 50, 0}, 1));
}

TEST(WidenFaults, strips_that_cross_share_a_cell_and_strips_end_on_strips) {
  const auto mesh = widened({fault("a", {{20, 50, 0}, {80, 50, 0}}), fault("b", {{40, 50, 0}, {40, 90, 0}}),
                             fault("c", {{60, 20, 0}, {60, 80, 0}})},
                            {{"a", 4}, {"b", 3}, {"c", 5}});
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  for (const Vec3& p : {Vec3{38.5, 52, 0}, Vec3{41.5, 52, 0}, Vec3{57.5, 52, 0}, Vec3{62.5, 48, 0}})
    EXPECT_TRUE(has_corner_at(*mesh, p)) << p.x;
  EXPECT_NEAR(feature_length(*mesh, "b left"), 38, 1e-9);
}

TEST(WidenFaults, names_must_be_faults_and_strips_thick_enough) {
  const auto unknown = widened({fault("a", {{20, 50, 0}, {80, 50, 0}})}, {{"b", 4}});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.failure().what.find("\"b\""), std::string::npos);
  EXPECT_FALSE(widened({fault("a", {{20, 50, 0}, {80, 50, 0}})}, {{"a", 0.1}}));
}

}  // namespace
}  // namespace strataflow
