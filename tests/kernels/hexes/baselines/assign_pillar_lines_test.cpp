#include "kernels/hexes/baselines/assign_pillar_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "kernels/hexes/baselines/plan_problems.h"

namespace strataflow {
namespace {

using support::plan_problem;
using testing::HasSubstr;

/// Per fault, whether I is constant along it.
std::map<std::string, bool> directions(const FeatureMesh& problem) {
  const Result<PillarLines> lines = assign_pillar_lines(problem);
  EXPECT_TRUE(lines) << describe(lines.failure());
  std::map<std::string, bool> found;
  if (lines)
    for (const PillarLine& line : lines->lines) found[line.name] = line.is_along_j;
  return found;
}

std::string refusal(const FeatureMesh& problem) {
  const Result<PillarLines> lines = assign_pillar_lines(problem);
  EXPECT_FALSE(lines);
  if (lines) return "";
  EXPECT_EQ(lines.failure().code, FailureCode::unsupported);
  return lines.failure().what;
}

TEST(AssignPillarLines, goes_by_direction_where_nothing_touches) {
  const auto found = directions(plan_problem({{{300, 200, 0}, {320, 600, 0}}, {{500, 400, 0}, {800, 420, 0}}}));
  EXPECT_TRUE(found.at("F1"));
  EXPECT_FALSE(found.at("F2"));
  EXPECT_EQ(found.size(), 6u);  // and four sides
}

TEST(AssignPillarLines, lets_the_side_a_fault_ends_on_decide) {
  // Nearer to I by direction, but it ends on the southern side.
  const auto found = directions(plan_problem({{{300, 0, 0}, {700, 300, 0}}}));
  EXPECT_TRUE(found.at("F1"));
}

TEST(AssignPillarLines, makes_faults_that_cross_or_abut_differ) {
  const auto found = directions(plan_problem(
      {{{400, 0, 0}, {400, 800, 0}}, {{100, 300, 0}, {700, 300, 0}}, {{400, 600, 0}, {700, 600, 0}}}));
  EXPECT_TRUE(found.at("F1"));
  EXPECT_FALSE(found.at("F2"));
  EXPECT_FALSE(found.at("F3"));
}

TEST(AssignPillarLines, keeps_faults_together_that_go_on_into_each_other) {
  const auto found = directions(plan_problem({{{400, 0, 0}, {400, 400, 0}}, {{400, 400, 0}, {420, 800, 0}}}));
  EXPECT_TRUE(found.at("F1"));
  EXPECT_TRUE(found.at("F2"));
}

TEST(AssignPillarLines, turns_its_frame_with_the_outline) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto turned = [&](double x, double y) { return Vec3{c * x - s * y, s * x + c * y, 0}; };
  const FeatureMesh problem = plan_problem({{turned(300, 200), turned(300, 600)}}, 100,
                                           {turned(0, 0), turned(1000, 0), turned(1000, 800), turned(0, 800)});
  const Result<PillarLines> lines = assign_pillar_lines(problem);
  ASSERT_TRUE(lines) << describe(lines.failure());
  EXPECT_NEAR(lines->frame.i.x, c, 1e-9);
  EXPECT_NEAR(lines->frame.i.y, s, 1e-9);
  EXPECT_TRUE(lines->lines[4].is_along_j);
}

TEST(AssignPillarLines, names_a_fault_that_fits_neither_direction) {
  // From the western to the northern side.
  const std::string corner = refusal(plan_problem({{{0, 400, 0}, {400, 800, 0}}}));
  EXPECT_THAT(corner, HasSubstr("fault F1"));
  EXPECT_THAT(corner, HasSubstr("low I"));
  EXPECT_THAT(corner, HasSubstr("high J"));
  // Three that meet in a triangle.
  const std::string triangle =
      refusal(plan_problem({{{200, 200, 0}, {700, 220, 0}}, {{250, 150, 0}, {500, 650, 0}}, {{650, 150, 0}, {400, 650, 0}}}));
  EXPECT_THAT(triangle, HasSubstr("neither in I nor in J"));
}

TEST(AssignPillarLines, refuses_outlines_without_four_sides) {
  EXPECT_THAT(refusal(plan_problem({}, 100, {{0, 0, 0}, {1000, 0, 0}, {1000, 400, 0}, {500, 400, 0}, {500, 800, 0}, {0, 800, 0}})),
              HasSubstr("turns 6 times"));
}

}  // namespace
}  // namespace strataflow
