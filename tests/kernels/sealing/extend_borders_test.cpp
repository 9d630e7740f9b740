#include "kernels/sealing/extend_borders.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using support::raw_box;

/// "H1 -> box 0.5" for every gap, one a line.
std::string gaps_of(const TriangleSoup& soup, const ExtendBordersOptions& options) {
  const Result<std::vector<BorderGap>> gaps = find_gaps(soup, options);
  if (!gaps) return describe(gaps.failure());
  std::string text;
  for (const BorderGap& gap : *gaps) {
    EXPECT_NEAR(gap.largest_m, 0.5, 1e-9);
    text += soup.entities[gap.entity].name + " -> " + soup.entities[gap.onto].name + "\n";
  }
  return text;
}

TEST(FindGaps, names_every_border_that_stops_short_within_the_distance) {
  EXPECT_EQ(gaps_of(raw_box(0.5, 3), {.distance_m = 0.6}), "F1 -> box\nH1 -> box\nH1 -> F1\n");
  EXPECT_EQ(gaps_of(raw_box(0.5, 3), {.distance_m = 0.4}), "");
}

TEST(FindGaps, a_named_contact_has_a_distance_of_its_own) {
  EXPECT_EQ(gaps_of(raw_box(0.5, 3), {.distance_m = 0.1, .contacts = {{"H1", "F1", 0.6}}}), "H1 -> F1\n");
}

TEST(FindGaps, refuses_a_contact_of_an_unknown_surface) {
  const auto gaps = find_gaps(raw_box(0.5, 3), {.distance_m = 0.1, .contacts = {{"H9", "F1", 0.6}}});
  ASSERT_FALSE(gaps);
  EXPECT_EQ(gaps.failure().code, FailureCode::invalid_options);
  EXPECT_NE(gaps.failure().what.find("H9"), std::string::npos);
}

TEST(ExtendBorders, go_past_what_they_should_reach_by_the_margin_and_corners_are_mitred) {
  const TriangleSoup raw = raw_box(0.5, 3);
  const Result<ExtendedBorders> extended = extend_borders(raw, {.distance_m = 0.6});
  ASSERT_TRUE(extended) << describe(extended.failure());
  EXPECT_EQ(extended->moved_points, 36u) << "the 12 border points of each of the three sheets";
  std::vector<Vec3> fault = support::positions_of(extended->soup, 1);
  const double margin = std::max(0.25 * 0.5, 0.05 * 3);
  EXPECT_NEAR(fault.front().y, -margin, 1e-9);
  EXPECT_NEAR(fault.front().z, -margin, 1e-9);
  EXPECT_NEAR(fault.back().y, 10 + margin, 1e-9);
  for (const Vec3& p : fault) EXPECT_EQ(p.x, 5) << "in the plane of its triangles";
}

TEST(ExtendBorders, what_reaches_nothing_stays_where_it_is) {
  const TriangleSoup floating = support::box_with_floating_fault();  // 1 from every wall
  const Result<ExtendedBorders> extended = extend_borders(floating, {.distance_m = 0.9});
  ASSERT_TRUE(extended);
  EXPECT_EQ(extended->moved_points, 0u);
  EXPECT_EQ(extended->soup.points, floating.points);
}

TEST(ExtendBorders, the_end_of_a_slit_stays_so_that_a_fault_goes_on_dying_there) {
  TriangleSoup soup;
  const std::uint32_t horizon = support::add_patch(soup, "H1", Role::horizon);
  const Vec3 end{5, 5, 0};
  support::add_triangle(soup, horizon, {0, 0, 0}, {4.8, 0, 0}, end);
  support::add_triangle(soup, horizon, {0, 0, 0}, end, {0, 10, 0});
  support::add_triangle(soup, horizon, end, {5, 10, 0}, {0, 10, 0});
  support::add_triangle(soup, horizon, {5.2, 0, 0}, {10, 0, 0}, end);
  support::add_triangle(soup, horizon, {10, 0, 0}, {10, 10, 0}, end);
  support::add_triangle(soup, horizon, end, {10, 10, 0}, {5, 10, 0});
  support::add_quad(soup, support::add_patch(soup, "F1", Role::fault), {5, -1, -3}, {5, 5.2, -3}, {5, 5.2, 3},
                    {5, -1, 3});
  const Result<ExtendedBorders> extended = extend_borders(soup, {.distance_m = 0.5});
  ASSERT_TRUE(extended) << describe(extended.failure());
  EXPECT_EQ(extended->moved_points, 2u) << "the two lips at the mouth";
  EXPECT_GT(extended->soup.points[1].x, 5);
  EXPECT_EQ(extended->soup.points[2], end);
  EXPECT_LT(extended->soup.points[9].x, 5);
}

}  // namespace
}  // namespace strataflow
