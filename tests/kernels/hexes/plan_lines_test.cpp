#include "kernels/hexes/plan_lines.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

std::vector<Polyline> lines_of(const ColumnModel& columns, double edge_m, bool with_horizon_lines = false) {
  return support::layered(support::filled(columns, edge_m), {{}, {}, with_horizon_lines, 600}).lines;
}

const Polyline& named(const std::vector<Polyline>& lines, std::string_view name) {
  for (const Polyline& line : lines)
    if (line.name == name) return line;
  ADD_FAILURE() << name << " is missing";
  return lines.front();
}

double length_of(const Polyline& line) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) sum += length(line.points[i + 1] - line.points[i]);
  if (line.is_closed) sum += length(line.points.front() - line.points.back());
  return sum;
}

TEST(PlanLines, are_the_outline_and_the_traces_of_faults) {
  const std::vector<Polyline> lines = lines_of(*vertical_faults(2, false), 100);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].role, Role::outline);
  EXPECT_TRUE(lines[0].is_closed);
  EXPECT_NEAR(length_of(lines[0]), 2 * 1600 + 2 * 1200, 1e-6);
  EXPECT_EQ(named(lines, "F1").role, Role::fault);
  EXPECT_NEAR(length_of(named(lines, "F1")), 1200, 1e-6);
  EXPECT_NEAR(length_of(named(lines, "F2")), 1600 * 8.0 / 12, 1e-6);
}

TEST(PlanLines, end_in_common_points_where_a_fault_meets_a_side) {
  const std::vector<Polyline> lines = lines_of(*dipping_faults(std::array{0.577}, 15), 100);
  const Polyline& outline = named(lines, "outline");
  for (const Vec3& end : {named(lines, "F1").points.front(), named(lines, "F1").points.back()})
    EXPECT_EQ(std::count(outline.points.begin(), outline.points.end(), end), 1);
}

TEST(PlanLines, leave_out_faults_that_are_not_aligned) {
  const LayeredSpace space = support::layered(support::filled(*vertical_faults(2, false), 100), {{"F2"}, {}, false, 600});
  EXPECT_EQ(space.lines.size(), 2u);
}

TEST(PlanLines, hold_the_lines_where_an_erosion_cuts_horizons_off_if_asked) {
  const std::vector<Polyline> lines = lines_of(*unconformity(false), 100, true);
  EXPECT_EQ(named(lines, "H3-E").role, Role::curve);
  EXPECT_NEAR(length_of(named(lines, "H3-E")), 1000, 120);
  EXPECT_EQ(lines_of(*unconformity(false), 100).size(), 1u);
}

TEST(PlanLines, chain_edges_between_ends_and_branches) {
  const std::vector<PointChain> chains = chain_edges({{0, 1}, {2, 1}, {2, 3}, {2, 4}, {5, 6}, {7, 6}, {5, 7}});
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[0].points, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(chains[3].points, (std::vector<std::uint32_t>{5, 6, 7}));
  EXPECT_TRUE(chains[3].is_closed);
}

TEST(PlanPosition, is_that_of_the_top_seen_from_above) {
  LabelledTets tets;
  tets.points = {{0, 0, 5}, {10, 0, 5}, {0, 10, 5}, {0, 0, 0}};
  tets.facets = {{{0, 1, 2}, 0, SheetKind::top, 1, {}}, {{0, 1, 3}, 0, SheetKind::side, 1, {}}};
  const std::vector<Vec3> plan = {{100, 0, 0}, {120, 0, 0}, {100, 20, 0}, {0, 0, 0}};
  const auto position = plan_position(tets, plan, 2.5, 5);
  ASSERT_TRUE(position);
  EXPECT_EQ(*position, (Vec3{105, 10, 0}));
  EXPECT_FALSE(plan_position(tets, plan, 9, 9));
}

}  // namespace
}  // namespace strataflow
