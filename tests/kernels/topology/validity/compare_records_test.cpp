#include "kernels/topology/validity/compare_records.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

PatchSide side(std::uint32_t patch, bool positive) { return {patch, static_cast<std::uint8_t>(positive), {}}; }

std::size_t count_of(const std::vector<Violation>& violations, const char* kind) {
  return static_cast<std::size_t>(
      std::count_if(violations.begin(), violations.end(), [&](const Violation& v) { return v.kind == kind; }));
}

/// Two layers with three patches: upper walls and top, lower walls and bottom, the horizon.
TriangleSoup two_named_layers() {
  TriangleSoup soup;
  const std::uint32_t upper = support::add_patch(soup, "upper", Role::boundary),
                      lower = support::add_patch(soup, "lower", Role::boundary),
                      horizon = support::add_patch(soup, "H", Role::horizon);
  support::add_walls(soup, lower, {0, 0, 0}, {1, 1, 0.5});
  support::add_sheet(soup, lower, {0, 0, 0}, {1, 1, 0}, 0);
  support::add_walls(soup, upper, {0, 0, 0.5}, {1, 1, 1});
  support::add_sheet(soup, upper, {0, 0, 0}, {1, 1, 1}, 1);
  support::add_sheet(soup, horizon, {0, 0, 0}, {1, 1, 1}, 0.5);
  soup.regions = {{"Universe", {side(0, false), side(1, false)}},
                  {"Top", {side(0, true), side(2, true)}},
                  {"Base", {side(1, true), side(2, false)}}};
  soup.layers = {{"young", {1}}, {"old", {2}}};
  return soup;
}

TEST(CompareRecords, regions_take_the_names_of_the_records_that_fit_best_whatever_their_signs) {
  TriangleSoup soup = two_named_layers();
  for (RegionRecord& record : soup.regions)
    for (PatchSide& s : record.sides) s.is_positive ^= 1;
  const StructuralModel model = build_structural_model(soup)->model;
  ASSERT_EQ(model.regions.size(), 2u);
  const std::uint32_t top =
      model.surfaces[0].region_plus == universe ? model.surfaces[0].region_minus : model.surfaces[0].region_plus;
  const std::string expected = model.entities[model.surfaces[0].entity].name == "upper" ? "Top" : "Base";
  EXPECT_EQ(model.regions[top].name, expected);
  ASSERT_EQ(model.layers.size(), 2u);
  EXPECT_EQ(model.regions[model.layers[0].regions.at(0)].name, "Top");
}

TEST(CompareRecords, a_stone_off_every_line_is_inconsistent) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  soup.border_stones = {0};  // a corner of the box: no line there
  EXPECT_EQ(count_of(build_structural_model(soup)->violations, "inconsistent_border"), 1u);
}

TEST(CompareRecords, a_border_that_starts_along_no_line_is_inconsistent) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  soup.border_starts = {{0, 1}};  // a bottom edge of the box
  EXPECT_EQ(count_of(build_structural_model(soup)->violations, "inconsistent_border"), 1u);
}

TEST(CompareRecords, a_border_along_a_line_is_fine) {
  TriangleSoup soup = two_named_layers();
  const auto at = [&](const Vec3& p) {
    return static_cast<std::uint32_t>(std::find(soup.points.begin(), soup.points.end(), p) - soup.points.begin());
  };
  // The shapes repeat points per triangle: the wall's upper edge runs between these two copies.
  const std::uint32_t start = at({0, 0, .5}), end = start - 1;
  ASSERT_EQ(soup.points[end], (Vec3{1, 0, .5}));
  soup.border_stones = {start};
  soup.border_starts = {{start, end}};
  EXPECT_TRUE(build_structural_model(soup)->violations.empty());
}

TEST(CompareRecords, a_border_between_copies_that_no_triangle_joins_is_inconsistent) {
  TriangleSoup soup = two_named_layers();
  const auto start = static_cast<std::uint32_t>(std::find(soup.points.begin(), soup.points.end(), Vec3{0, 0, .5}) -
                                                soup.points.begin());
  soup.points.push_back({1, 0, .5});
  soup.border_starts = {{start, static_cast<std::uint32_t>(soup.points.size() - 1)}};
  EXPECT_EQ(count_of(build_structural_model(soup)->violations, "inconsistent_border"), 1u);
}

TEST(CompareRecords, a_wall_that_should_part_two_regions_but_does_not_leaks) {
  TriangleSoup soup = support::box({0, 0, 0}, {4, 4, 4});
  const std::uint32_t wall = support::add_patch(soup, "wall", Role::fault);
  support::add_quad(soup, wall, {1, 2, 1}, {3, 2, 1}, {3, 2, 3}, {1, 2, 3});
  soup.regions = {{"West", {side(0, true), side(wall, true)}}, {"East", {side(0, true), side(wall, false)}}};
  const std::vector<Violation> violations = build_structural_model(soup)->violations;
  ASSERT_EQ(count_of(violations, "leak"), 1u);
  EXPECT_NE(violations[0].what.find("'wall'"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
