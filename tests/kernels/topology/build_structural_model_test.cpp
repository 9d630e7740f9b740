#include "kernels/topology/build_structural_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/archive.h"
#include "base/digest.h"
#include "base/seed.h"
#include "kernels/topology/check_validity.h"
#include "support/schedules.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::add_patch;
using support::add_quad;

BuiltModel built(const TriangleSoup& soup) {
  Result<BuiltModel> result = build_structural_model(soup);
  EXPECT_TRUE(result) << (result ? "" : describe(result.failure()));
  return result ? *result : BuiltModel{};
}

std::vector<double> volumes(const StructuralModel& model) {
  std::vector<double> list;
  for (const Region& region : model.regions) list.push_back(region.volume_m3);
  std::sort(list.begin(), list.end());
  return list;
}

std::array<std::size_t, 4> counts(const StructuralModel& m) {
  return {m.corners.size(), m.lines.size(), m.surfaces.size(), m.regions.size()};
}

TEST(BuildStructuralModel, a_box_is_one_region_bounded_by_one_surface) {
  const StructuralModel model = built(support::box()).model;
  EXPECT_EQ(counts(model), (std::array<std::size_t, 4>{0, 0, 1, 1}));
  EXPECT_EQ(model.points.size(), 8u);
  EXPECT_DOUBLE_EQ(model.regions[0].volume_m3, 1.0);
  EXPECT_TRUE(model.is_sealed);
}

TEST(BuildStructuralModel, a_horizon_through_a_box_parts_it_along_one_closed_line) {
  const StructuralModel model = built(support::layered_box({0, 0.3, 1})).model;
  EXPECT_EQ(counts(model), (std::array<std::size_t, 4>{0, 1, 3, 2}));
  EXPECT_TRUE(model.lines[0].is_closed());
  EXPECT_EQ(model.lines[0].vertices.size(), 4u);
  EXPECT_NEAR(volumes(model)[0], 0.3, 1e-15);
  EXPECT_NEAR(volumes(model)[1], 0.7, 1e-15);
}

TEST(BuildStructuralModel, a_box_in_a_box_leaves_a_region_with_a_cavity) {
  const StructuralModel model = built(support::nested_boxes()).model;
  ASSERT_EQ(model.regions.size(), 2u);
  EXPECT_DOUBLE_EQ(volumes(model)[0], 1.0);
  EXPECT_DOUBLE_EQ(volumes(model)[1], 26.0);
  const Region& outer = model.regions[model.regions[0].volume_m3 > 2 ? 0 : 1];
  EXPECT_EQ(outer.internal_frontiers.size(), 1u);
}

TEST(BuildStructuralModel, three_boxes_in_each_other_nest_by_the_innermost) {
  TriangleSoup soup = support::nested_boxes();
  support::add_box(soup, add_patch(soup, "core"), {1.25, 1.25, 1.25}, {1.75, 1.75, 1.75});
  const StructuralModel model = built(soup).model;
  EXPECT_EQ(volumes(model), (std::vector<double>{0.125, 0.875, 26.0}));
}

TEST(BuildStructuralModel, a_fault_that_floats_in_a_region_has_it_on_both_sides) {
  const BuiltModel whole = built(support::box_with_floating_fault());
  ASSERT_EQ(whole.model.surfaces.size(), 2u);
  EXPECT_TRUE(whole.model.surfaces[1].is_dangling());
  EXPECT_EQ(whole.model.surfaces[1].region_plus, 0u);
  const ValidityReport report = check_validity(whole);
  EXPECT_TRUE(report.is_valid());
  ASSERT_EQ(report.violations.size(), 1u);
  EXPECT_EQ(report.violations[0].kind, "dangling_surface");
}

TEST(BuildStructuralModel, an_open_box_encloses_nothing) {
  TriangleSoup soup = support::box();
  soup.triangles.pop_back();
  soup.triangle_patch.pop_back();
  const BuiltModel whole = built(soup);
  EXPECT_TRUE(whole.model.regions.empty());
  EXPECT_FALSE(whole.model.is_sealed);
  const ValidityReport report = check_validity(whole);
  EXPECT_FALSE(report.is_valid());
  EXPECT_EQ(report.violations[0].kind, "open_shell");
}

TEST(BuildStructuralModel, the_sign_of_a_volume_is_exact_even_for_a_sliver) {
  // A tetrahedron whose fourth vertex leaves the plane of the others by the last bit of a large coordinate.
  TriangleSoup soup;
  const std::uint32_t patch = add_patch(soup, "sliver");
  const double top = std::nextafter(1e6, 2e6);
  const Vec3 a{0, 0, 1e6}, b{1e6, 0, 1e6}, c{0, 1e6, 1e6}, d{1, 1, top};
  support::add_triangle(soup, patch, a, c, b);
  support::add_triangle(soup, patch, a, b, d);
  support::add_triangle(soup, patch, b, c, d);
  support::add_triangle(soup, patch, c, a, d);
  EXPECT_EQ(built(soup).model.regions.size(), 1u);
}

TEST(BuildStructuralModel, repeated_and_collapsed_triangles_are_dropped_and_named) {
  TriangleSoup soup = support::box();
  soup.triangles.push_back(soup.triangles[0]);
  soup.triangle_patch.push_back(0);
  soup.triangles.push_back({0, 1, 1});
  soup.triangle_patch.push_back(0);
  const BuiltModel whole = built(soup);
  EXPECT_EQ(whole.model.triangles.size(), 12u);
  ASSERT_EQ(whole.violations.size(), 2u);
  EXPECT_EQ(whole.violations[0].kind, "degenerate_triangle");
  EXPECT_EQ(whole.violations[1].kind, "duplicate_triangle");
  EXPECT_TRUE(is_mended_by_building(whole.violations[0]));
  EXPECT_TRUE(is_mended_by_building(whole.violations[1]));
}

TEST(BuildStructuralModel, a_moebius_strip_is_refused_by_name) {
  TriangleSoup soup;
  const std::uint32_t patch = add_patch(soup, "strip");
  constexpr int steps = 12;
  const auto rim = [&](int i, double side) {
    const double turn = 2 * M_PI * (i % steps) / steps, half = turn / 2;
    const double way = i >= steps ? -side : side;
    const double r = 3 + way * std::cos(half);
    return Vec3{r * std::cos(turn), r * std::sin(turn), way * std::sin(half)};
  };
  for (int i = 0; i < steps; ++i) add_quad(soup, patch, rim(i, -1), rim(i + 1, -1), rim(i + 1, 1), rim(i, 1));
  const BuiltModel whole = built(soup);
  ASSERT_FALSE(whole.violations.empty());
  EXPECT_EQ(whole.violations[0].kind, "non_orientable_surface");
}

TEST(BuildStructuralModel, refuses_no_triangles) {
  const Result<BuiltModel> result = build_structural_model({});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.failure().code, FailureCode::invalid_input);
}

/// The soup with triangles in another order, some turned over, points renumbered and moved rigidly.
TriangleSoup disturbed(const TriangleSoup& soup, std::uint64_t seed) {
  RandomStream random(seed);
  TriangleSoup out = soup;
  for (std::size_t i = out.triangles.size(); i > 1; --i) {
    const auto j = static_cast<std::size_t>(random.below(i));
    std::swap(out.triangles[i - 1], out.triangles[j]);
    std::swap(out.triangle_patch[i - 1], out.triangle_patch[j]);
  }
  for (Triangle& t : out.triangles)
    if (random.below(2)) std::swap(t[0], t[1]);
  for (Vec3& p : out.points) p = {p.y + 5e6, -p.x + 5e6, p.z};  // a quarter turn and a shift, exact for these shapes
  return out;
}

TEST(BuildStructuralModel, order_orientation_and_rigid_motion_change_no_count_and_no_volume) {
  const TriangleSoup soup = support::layered_box({0, 0.25, 0.5, 1});
  const StructuralModel expected = built(soup).model;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const StructuralModel model = built(disturbed(soup, seed)).model;
    EXPECT_EQ(counts(model), counts(expected));
    const std::vector<double> got = volumes(model), want = volumes(expected);
    ASSERT_EQ(got.size(), want.size());
    for (std::size_t r = 0; r < got.size(); ++r) EXPECT_NEAR(got[r], want[r], 1e-9 * want[r]);
  }
}

TEST(BuildStructuralModel, gives_the_same_bytes_on_every_schedule) {
  const TriangleSoup soup = disturbed(support::layered_box({0, 0.1, 0.2, 0.4, 1}), 3);
  const Digest expected = digest_of(archived(built(soup)));
  const Digest judged = digest_of(archived(check_validity(built(soup))));
  support::on_every_schedule([&](const char* schedule) {
    const BuiltModel whole = built(soup);
    EXPECT_EQ(digest_of(archived(whole)), expected) << schedule;
    EXPECT_EQ(digest_of(archived(check_validity(whole))), judged) << schedule;
  });
}

TEST(BuildStructuralModel, archives_and_comes_back) {
  const BuiltModel whole = built(support::nested_boxes());
  const auto back = unarchived<BuiltModel>(archived(whole));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(archived(*back), archived(whole));
}

TEST(CheckValidity, two_boxes_through_each_other_cross) {
  TriangleSoup soup = support::box({0, 0, 0}, {2, 2, 2});
  support::add_box(soup, add_patch(soup, "other"), {1, 1, 1}, {3, 3, 3});
  const ValidityReport report = check_validity(built(soup));
  EXPECT_GT(report.intersecting_triangle_pairs, 0u);
  EXPECT_EQ(report.self_intersecting_pairs, 0u);
  EXPECT_TRUE(std::any_of(report.violations.begin(), report.violations.end(),
                          [](const Violation& v) { return v.kind == "improper_intersection"; }));
}

TEST(CheckValidity, a_contact_with_other_vertices_on_it_does_not_conform) {
  // The horizon's border has a vertex in the middle of a box edge that the wall does not have.
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  TriangleSoup broken = soup;
  const std::size_t horizon = soup.triangles.size() - 2;
  broken.triangles.resize(horizon);
  broken.triangle_patch.resize(horizon);
  const std::uint32_t patch = soup.triangle_patch[horizon];
  const Vec3 a{0, 0, .5}, m{.5, 0, .5}, b{1, 0, .5}, c{1, 1, .5}, d{0, 1, .5};
  support::add_triangle(broken, patch, a, m, d);
  support::add_triangle(broken, patch, m, b, c);
  support::add_triangle(broken, patch, m, c, d);
  const BuiltModel whole = built(broken);
  const ValidityReport report = check_validity(whole);
  EXPECT_FALSE(report.is_valid());
  EXPECT_FALSE(is_sealed(whole.model, report));
  EXPECT_TRUE(std::any_of(report.violations.begin(), report.violations.end(),
                          [](const Violation& v) { return v.kind == "non_conforming_contact"; }));
}

TEST(CheckValidity, the_same_sheet_under_two_names_coincides) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  support::add_sheet(soup, add_patch(soup, "H1 again"), {0, 0, 0}, {1, 1, 1}, 0.5);
  const ValidityReport report = check_validity(built(soup));
  EXPECT_TRUE(std::any_of(report.violations.begin(), report.violations.end(),
                          [](const Violation& v) { return v.kind == "coincident_surfaces" && v.count == 2; }));
}

TEST(CheckValidity, a_triangle_without_area_is_named) {
  TriangleSoup soup = support::box();
  support::add_triangle(soup, add_patch(soup, "flat"), {5, 0, 0}, {6, 0, 0}, {7, 0, 0});
  const ValidityReport report = check_validity(built(soup));
  EXPECT_TRUE(std::any_of(report.violations.begin(), report.violations.end(), [](const Violation& v) {
    return v.kind == "degenerate_triangle" && v.what.find("'flat'") != std::string::npos;
  }));
}

}  // namespace
}  // namespace strataflow
