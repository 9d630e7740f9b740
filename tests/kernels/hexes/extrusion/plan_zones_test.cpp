#include "kernels/hexes/extrusion/plan_zones.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// n × n unit squares.
QuadMesh squares(std::uint32_t n) {
  QuadMesh plan;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) plan.points.push_back({double(i), double(j), 0});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t p = j * (n + 1) + i;
      plan.quads.push_back({p, p + 1, p + n + 2, p + n + 1});
    }
  return plan;
}

TEST(PlanZones, are_the_quads_between_both_sides_of_a_volumetric_fault) {
  QuadMesh plan = squares(4);
  plan.features = {{"F1 left", Role::fault, 1, 1},
                   {"F1 right", Role::fault, 0, -1},
                   {"F1 end", Role::fault, 0, -1},
                   {"F2", Role::fault, 0, -1}};
  plan.edges = {{1, 6, 0}, {2, 7, 1}, {6, 7, 2}, {3, 8, 3}};  // one square high, between x = 1 and x = 2
  const PlanZones found = find_plan_zones(plan);
  ASSERT_EQ(found.zones.size(), 1u);
  EXPECT_EQ(found.zones[0].name, "F1");
  for (std::uint32_t q = 0; q < plan.quads.size(); ++q) EXPECT_EQ(found.zone_of[q], q == 1 ? 0 : -1) << q;
  EXPECT_EQ(found.is_strip_feature, (std::vector<char>{1, 1, 1, 0}));
  EXPECT_TRUE(found.is_on_strip[1] && found.is_on_strip[7]);
  EXPECT_FALSE(found.is_on_strip[3]);
}

TEST(PlanZones, are_as_many_rows_as_the_strip_has) {
  QuadMesh plan = squares(4);
  plan.features = {{"F1 left", Role::fault, 2, 1}, {"F1 right", Role::fault, 0, -1}};
  plan.edges = {{1, 6, 0}, {3, 8, 1}};
  const PlanZones found = find_plan_zones(plan);
  for (std::uint32_t q = 0; q < plan.quads.size(); ++q) EXPECT_EQ(found.zone_of[q], q == 1 || q == 2 ? 0 : -1) << q;
}

TEST(PlanZones, are_the_quads_inside_the_curve_around_a_well) {
  QuadMesh plan = squares(3);
  plan.features = {{"W1", Role::well, 0, -1}};
  plan.edges = {{5, 6, 0}, {5, 9, 0}, {6, 10, 0}, {9, 10, 0}};
  const PlanZones found = find_plan_zones(plan);
  ASSERT_EQ(found.zones.size(), 1u);
  for (std::uint32_t q = 0; q < plan.quads.size(); ++q) EXPECT_EQ(found.zone_of[q], q == 4 ? 0 : -1) << q;
  plan.edges.pop_back();  // open: a well that leans
  EXPECT_TRUE(find_plan_zones(plan).zones.empty());
}

}  // namespace
}  // namespace strataflow
