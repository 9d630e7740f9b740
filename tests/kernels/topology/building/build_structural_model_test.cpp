#include "kernels/topology/building/build_structural_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/archive.h"
#include "base/digest.h"
#include "base/seed.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/topology/validity/check_validity.h"
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
  EXPECT_TRUE(whole.violations[0].is_mended);
  EXPECT_TRUE(whole.violations[1].is_mended);
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

std::vector<std::string> kinds(const std::vector<Violation>& violations) {
  std::vector<std::string> list;
  for (const Violation& violation : violations) list.push_back(violation.kind);
  return list;
}

TEST(BuildStructuralModel, the_same_sheet_under_two_names_is_one_surface_of_both) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  support::add_sheet(soup, add_patch(soup, "H1 again", Role::horizon), {0, 0, 0}, {1, 1, 1}, 0.5);
  const BuiltModel whole = built(soup);
  EXPECT_EQ(counts(whole.model), (std::array<std::size_t, 4>{0, 1, 3, 2}));
  EXPECT_EQ(whole.model.triangles.size(), soup.triangles.size() - 2);
  const Surface& both = whole.model.surfaces[2];
  EXPECT_EQ(both.all_entities, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(both.entity, 2u);
  const ValidityReport report = check_validity(whole);
  EXPECT_TRUE(report.is_valid());
  EXPECT_TRUE(is_sealed(whole.model, report));
  ASSERT_EQ(kinds(report.violations), std::vector<std::string>{"coincident_surfaces"});
  EXPECT_EQ(report.violations[0].count, 2u);
  EXPECT_NE(report.violations[0].what.find("'H1' and 'H1 again' coincide on 2 triangles, 1.0"), std::string::npos);
  EXPECT_EQ(report.intersecting_triangle_pairs, 2u);  // of the input
  EXPECT_EQ(report.self_intersecting_pairs, 0u);
}

TEST(BuildStructuralModel, a_patch_of_several_entities_is_a_surface_of_all_of_them) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  soup.entities.push_back({"F", Role::fault});
  soup.entities.push_back({"H", Role::horizon});
  soup.patch_other_entities = {{}, {2, 3}};
  const BuiltModel once = built(soup);
  EXPECT_EQ(once.model.surfaces[2].all_entities, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(once.model.surfaces[2].entity, 2u);
  const ValidityReport report = check_validity(once);
  EXPECT_TRUE(report.violations.empty());
  EXPECT_TRUE(is_sealed(once.model, report));
  EXPECT_EQ(report.intersecting_triangle_pairs, 0u);  // the copies are gone
  // A copy of one of them adds nothing; a copy of another does.
  soup.patch_entity.insert(soup.patch_entity.end(), {3, 4});
  soup.entities.push_back({"B", Role::boundary});
  soup.patch_other_entities.resize(4);
  for (const std::uint32_t patch : {2u, 3u}) support::add_sheet(soup, patch, {0, 0, 0}, {1, 1, 1}, 0.5);
  const BuiltModel more = built(soup);
  EXPECT_EQ(more.model.surfaces[2].all_entities, (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(kinds(more.violations), (std::vector<std::string>{"duplicate_triangle", "coincident_surfaces"}));
  EXPECT_EQ(check_validity(more).intersecting_triangle_pairs, 2u * 3u);
}

TEST(CheckValidity, counts_pairs_of_the_input_however_often_its_triangles_are_repeated) {
  TriangleSoup soup;
  const std::uint32_t fault = add_patch(soup, "F", Role::fault);
  support::add_triangle(soup, fault, {0, 0, -1}, {3, 3, -1}, {1, 1, 4});
  for (const char* name : {"H1", "H2", "H3"})
    support::add_triangle(soup, add_patch(soup, name, Role::horizon), {0, 1, 0}, {3, 1, 0}, {1, 3, 0});
  ASSERT_EQ(find_intersections(soup.points, soup.triangles).size(), 3u + 3u);  // crossings, identical ones
  ValidityReport report = check_validity(built(soup));
  EXPECT_EQ(report.intersecting_triangle_pairs, 3u + 3u);
  EXPECT_EQ(report.identical_triangle_pairs, 3u);
  EXPECT_EQ(report.self_intersecting_pairs, 0u);
  support::add_triangle(soup, fault, {0, 0, -1}, {3, 3, -1}, {1, 1, 4});  // the fault, too, is given twice
  report = check_validity(built(soup));
  EXPECT_EQ(report.intersecting_triangle_pairs, 2u * 3u + 3u + 1u);
  EXPECT_EQ(report.self_intersecting_pairs, 1u);
  std::uint64_t crossings = 0;
  for (const Violation& violation : report.violations)
    if (violation.kind == "improper_intersection") crossings += violation.count;
  EXPECT_EQ(crossings, 6u);
}

TEST(CheckValidity, the_volume_of_a_thin_region_in_a_wide_model_balances_but_for_rounding) {
  TriangleSoup soup;
  support::add_box(soup, add_patch(soup, "sliver"), {4000.1, 3000.3, 0.7}, {4010.2, 3001.4, 0.7000001});
  support::add_sheet(soup, add_patch(soup, "wide"), {-20000, -20000, 0}, {20000, 20000, 0}, 50);
  BuiltModel whole = built(soup);
  const auto has_imbalance = [&] {
    const std::vector<std::string> found = kinds(check_validity(whole).violations);
    return std::count(found.begin(), found.end(), "volume_imbalance") > 0;
  };
  whole.model.regions.at(0).volume_m3 *= 1 + 1e-8;  // as rounding at this distance does
  EXPECT_FALSE(has_imbalance());
  whole.model.regions.at(0).volume_m3 += 100;
  EXPECT_TRUE(has_imbalance());
}

/// A box cut by a horizon at z = 1 and one that lies on it for x < 1, and rises to z = 2 at x = 2.
TriangleSoup pinched_out_layer() {
  TriangleSoup soup;
  const std::uint32_t wall = add_patch(soup, "box", Role::boundary);
  const std::uint32_t young = add_patch(soup, "young", Role::horizon), old = add_patch(soup, "old", Role::horizon);
  std::swap(soup.patch_entity[young], soup.patch_entity[old]);  // patches in one order, entities in the other
  for (const std::uint32_t horizon : {young, old}) add_quad(soup, horizon, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1});
  add_quad(soup, young, {1, 0, 1}, {2, 0, 2}, {2, 1, 2}, {1, 1, 1});
  add_quad(soup, old, {1, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1});
  add_quad(soup, wall, {0, 0, 0}, {0, 1, 0}, {2, 1, 0}, {2, 0, 0});
  add_quad(soup, wall, {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3});
  for (const double y : {0.0, 1.0}) {
    add_quad(soup, wall, {0, y, 0}, {2, y, 0}, {2, y, 1}, {1, y, 1});
    support::add_triangle(soup, wall, {0, y, 0}, {1, y, 1}, {0, y, 1});
    support::add_triangle(soup, wall, {1, y, 1}, {2, y, 1}, {2, y, 2});
    add_quad(soup, wall, {0, y, 3}, {2, y, 3}, {2, y, 2}, {1, y, 1});
    support::add_triangle(soup, wall, {0, y, 3}, {1, y, 1}, {0, y, 1});
  }
  add_quad(soup, wall, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1});
  add_quad(soup, wall, {0, 0, 1}, {0, 1, 1}, {0, 1, 3}, {0, 0, 3});
  add_quad(soup, wall, {2, 0, 0}, {2, 1, 0}, {2, 1, 1}, {2, 0, 1});
  add_quad(soup, wall, {2, 0, 1}, {2, 1, 1}, {2, 1, 2}, {2, 0, 2});
  add_quad(soup, wall, {2, 0, 2}, {2, 1, 2}, {2, 1, 3}, {2, 0, 3});
  return soup;
}

TEST(BuildStructuralModel, a_layer_that_pinches_out_leaves_a_surface_of_both_horizons_and_no_region_there) {
  const BuiltModel whole = built(pinched_out_layer());
  EXPECT_EQ(volumes(whole.model), (std::vector<double>{0.5, 2.0, 3.5}));
  std::size_t shared = 0;
  for (const Surface& surface : whole.model.surfaces) {
    if (surface.all_entities.size() == 1) continue;
    ++shared;
    EXPECT_EQ(surface.all_entities, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(whole.model.entities[surface.entity].name, "old");  // the later in input order
    EXPECT_NE(surface.region_plus, surface.region_minus);
  }
  EXPECT_EQ(shared, 1u);
  const ValidityReport report = check_validity(whole);
  EXPECT_TRUE(is_sealed(whole.model, report));
  EXPECT_EQ(kinds(report.violations), std::vector<std::string>{"coincident_surfaces"});
}

TEST(BuildStructuralModel, a_fault_on_a_horizon_is_the_younger_whatever_the_order) {
  TriangleSoup soup;
  support::add_sheet(soup, add_patch(soup, "F", Role::fault), {0, 0, 0}, {1, 1, 1}, 0.5);
  support::add_sheet(soup, add_patch(soup, "H", Role::horizon), {0, 0, 0}, {1, 1, 1}, 0.5);
  EXPECT_EQ(built(soup).model.surfaces.at(0).entity, 0u);
}

TEST(BuildStructuralModel, patches_of_one_entity_that_repeat_each_other_leave_one_surface) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  soup.patch_entity.push_back(1);
  support::add_sheet(soup, 2, {0, 0, 0}, {1, 1, 1}, 0.5);
  const BuiltModel whole = built(soup);
  EXPECT_EQ(counts(whole.model), (std::array<std::size_t, 4>{0, 1, 3, 2}));
  EXPECT_EQ(whole.model.surfaces[2].all_entities, std::vector<std::uint32_t>{1});
  ASSERT_EQ(kinds(whole.violations), std::vector<std::string>{"duplicate_triangle"});
  EXPECT_TRUE(whole.violations[0].is_mended);
}

TEST(BuildStructuralModel, sheets_that_overlap_without_identical_triangles_stay_an_error) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  const std::uint32_t again = add_patch(soup, "H1 again", Role::horizon);
  add_quad(soup, again, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}, {0, 0, .5});  // the other diagonal
  EXPECT_FALSE(check_validity(built(soup)).is_valid());
}

TEST(BuildStructuralModel, a_coincidence_survives_any_order_of_the_triangles) {
  TriangleSoup soup = pinched_out_layer();
  std::reverse(soup.triangles.begin(), soup.triangles.end());
  std::reverse(soup.triangle_patch.begin(), soup.triangle_patch.end());
  const StructuralModel model = built(soup).model, expected = built(pinched_out_layer()).model;
  EXPECT_EQ(counts(model), counts(expected));
  for (std::size_t r = 0; r < expected.regions.size(); ++r)
    EXPECT_NEAR(volumes(model).at(r), volumes(expected)[r], 1e-14);
}

TEST(BuildStructuralModel, where_the_order_around_a_line_is_unknown_so_are_the_volumes_it_may_concern) {
  // A box whose top and a second, larger flap leave one edge in the same direction; a box far away is not concerned.
  TriangleSoup soup = support::box({0, 0, 0}, {1, 1, 1});
  add_quad(soup, add_patch(soup, "flap"), {0, 0, 1}, {1, 0, 1}, {1, 2, 1}, {0, 2, 1});
  support::add_box(soup, add_patch(soup, "far"), {5, 5, 5}, {6, 6, 6});
  support::add_box(soup, add_patch(soup, "around"), {-1, -1, -1}, {3, 3, 3});
  const BuiltModel whole = built(soup);
  const ValidityReport report = check_validity(whole);
  const auto kind = kinds(report.violations);
  EXPECT_TRUE(std::count(kind.begin(), kind.end(), "unsorted_contact"));
  EXPECT_FALSE(std::count(kind.begin(), kind.end(), "volume_imbalance"));
  std::size_t known = 0;
  for (const Region& region : whole.model.regions) {
    if (std::isnan(region.volume_m3)) continue;
    ++known;
    EXPECT_EQ(region.volume_m3, 1.0);  // the one far away
  }
  EXPECT_EQ(known, 1u);
  const auto unknown = std::find_if(report.violations.begin(), report.violations.end(),
                                    [](const Violation& v) { return v.kind == "unknown_volume"; });
  ASSERT_NE(unknown, report.violations.end());
  EXPECT_EQ(unknown->count, whole.model.regions.size() - 1);
}

TEST(BuildStructuralModel, a_fault_that_touches_the_shell_in_its_vertices_only_lies_inside) {
  // The walls are quads fanned around their centres; the fault's three vertices are three such centres.
  TriangleSoup soup;
  const std::uint32_t wall = add_patch(soup, "box", Role::boundary);
  const auto fan = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 centre = 0.25 * (a + b + c + d);
    support::add_triangle(soup, wall, centre, a, b);
    support::add_triangle(soup, wall, centre, b, c);
    support::add_triangle(soup, wall, centre, c, d);
    support::add_triangle(soup, wall, centre, d, a);
  };
  fan({0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0});
  fan({0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2});
  fan({0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2});
  fan({0, 2, 0}, {0, 2, 2}, {2, 2, 2}, {2, 2, 0});
  fan({0, 0, 0}, {0, 0, 2}, {0, 2, 2}, {0, 2, 0});
  fan({2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2});
  support::add_triangle(soup, add_patch(soup, "F", Role::fault), {1, 0, 1}, {0, 1, 1}, {1, 1, 2});
  const BuiltModel whole = built(soup);
  ASSERT_EQ(whole.model.regions.size(), 1u);
  EXPECT_EQ(whole.model.surfaces.at(1).region_plus, 0u);
  const ValidityReport report = check_validity(whole);
  EXPECT_TRUE(is_sealed(whole.model, report));
  EXPECT_TRUE(report.is_valid());
}

TEST(BuildStructuralModel, of_copies_with_different_values_the_first_with_data_counts_and_is_reported) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  PointProperty porosity{"porosity", "", 1, std::vector<double>(soup.points.size(), 0.2)};
  PointProperty same{"same", "", 1, std::vector<double>(soup.points.size(), 7.0)};
  const double no_data = std::nan("");
  std::vector<std::uint32_t> copies;
  for (std::uint32_t i = 0; i < soup.points.size(); ++i)
    if (soup.points[i] == Vec3{0, 0, 0}) copies.push_back(i);
  ASSERT_GE(copies.size(), 3u);
  same.values[copies[0]] = no_data;
  porosity.values[copies[0]] = no_data;
  porosity.values[copies[1]] = 0.3;
  soup.properties = {porosity, same};
  const BuiltModel whole = built(soup);
  ASSERT_EQ(kinds(whole.violations), std::vector<std::string>{"torn_property"});
  EXPECT_EQ(whole.violations[0].count, 1u);
  EXPECT_NE(whole.violations[0].what.find("'porosity': 1 points"), std::string::npos);
  const auto v = static_cast<std::size_t>(
      std::find(whole.model.points.begin(), whole.model.points.end(), Vec3{0, 0, 0}) - whole.model.points.begin());
  EXPECT_EQ(whole.model.properties[0].values[v], 0.3);
  EXPECT_EQ(whole.model.properties[1].values[v], 7.0);
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
