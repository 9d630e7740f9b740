#include "kernels/cutting/cut_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "kernels/cutting/exact_reference.h"
#include "kernels/cutting/surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/weld_points.h"
#include "support/sanitized.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::add_grid;
using support::placed_triangles;

CutResult cut(const TriangleSoup& soup, const CutSurfacesOptions& options = {}) {
  Result<CutResult> result = cut_surfaces(soup, options);
  EXPECT_TRUE(result) << describe(result.failure());
  return std::move(*result);
}

/// Independent of the cutter's own census.
std::size_t improper_pairs(const TriangleSoup& soup) { return support::improper_pairs(soup.points, soup.triangles); }

template <class T>
std::vector<std::byte> archive_bytes(const T& value) {
  ArchiveWriter writer;
  writer(value);
  return writer.take();
}

double area_of(const TriangleSoup& soup, const std::string& name) {
  double area = 0;
  for (const support::PlacedTriangle& t : placed_triangles(soup, name))
    area += 0.5 * length(cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
  return area;
}

TEST(CutSurfaces, leaves_what_does_not_meet_exactly_as_it_is) {
  TriangleSoup soup = support::layered_box({0, 1, 2});
  soup.border_stones = {0, 1};
  const CutResult result = cut(soup);
  EXPECT_EQ(archive_bytes(result.soup), archive_bytes(soup));
  EXPECT_EQ(result.report.intersecting_pairs, 0u);
  EXPECT_TRUE(result.changes.empty());
}

TEST(CutSurfaces, makes_crossing_surfaces_conform) {
  const TriangleSoup soup = support::horizon_and_fault();
  const CutResult result = cut(soup);
  EXPECT_GT(improper_pairs(soup), 0u);
  EXPECT_EQ(improper_pairs(result.soup), 0u);
  EXPECT_EQ(result.report.pairs_left, 0u);
  EXPECT_EQ(result.report.intersecting_pairs, improper_pairs(soup));
  EXPECT_EQ(result.soup.triangles.size(), soup.triangles.size() - result.report.cut_triangles + result.report.pieces);
  EXPECT_NEAR(area_of(result.soup, "H1"), 4, 1e-12);
  EXPECT_NEAR(area_of(result.soup, "F1"), area_of(soup, "F1"), 1e-12);
}

TEST(CutSurfaces, keeps_entities_and_patches) {
  TriangleSoup soup;
  soup.local_origin = {4e5, 6e6, 0};
  support::add_triangle(soup, support::add_patch(soup, "H1", Role::horizon), {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  soup.patch_entity.push_back(0);  // a second patch of the same horizon
  support::add_triangle(soup, 1, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  support::add_triangle(soup, support::add_patch(soup, "F1", Role::fault), {1, -1, -1}, {1, 9, -1}, {1, 1, 3});
  const CutResult result = cut(soup);
  EXPECT_EQ(result.soup.local_origin, soup.local_origin);
  EXPECT_EQ(archive_bytes(result.soup.entities), archive_bytes(soup.entities));
  EXPECT_EQ(result.soup.patch_entity, soup.patch_entity);
  ASSERT_EQ(result.soup.triangle_patch.size(), result.soup.triangles.size());
  double area[2] = {0, 0};
  for (std::size_t t = 0; t < result.soup.triangles.size(); ++t) {
    const Triangle& v = result.soup.triangles[t];
    const std::uint32_t patch = result.soup.triangle_patch[t];
    if (patch < 2)
      area[patch] += 0.5 * cross(result.soup.points[v[1]] - result.soup.points[v[0]],
                                 result.soup.points[v[2]] - result.soup.points[v[0]])
                               .z;
  }
  EXPECT_NEAR(area[0], 8, 1e-12);
  EXPECT_NEAR(area[1], 8, 1e-12);
}

TEST(CutSurfaces, interpolates_properties_linearly) {
  TriangleSoup soup = support::horizon_and_fault();
  const auto depth = [](const Vec3& p) { return 100 + 3 * p.x - 2 * p.y + 7 * p.z; };
  soup.properties = {{"depth", "m", 1, {}}, {"direction", "", 3, {}}};
  for (const Vec3& p : soup.points) {
    soup.properties[0].values.push_back(depth(p));
    soup.properties[1].values.insert(soup.properties[1].values.end(), {p.y, -p.x, 5});
  }
  const CutResult result = cut(soup);
  ASSERT_EQ(result.soup.properties.size(), 2u);
  EXPECT_EQ(result.soup.properties[0].unit, "m");
  ASSERT_EQ(result.soup.properties[0].values.size(), result.soup.points.size());
  ASSERT_EQ(result.soup.properties[1].values.size(), 3 * result.soup.points.size());
  EXPECT_GT(result.soup.points.size(), soup.points.size());
  for (std::size_t i = 0; i < result.soup.points.size(); ++i) {
    const Vec3& p = result.soup.points[i];
    EXPECT_NEAR(result.soup.properties[0].values[i], depth(p), 1e-11);
    EXPECT_NEAR(result.soup.properties[1].values[3 * i], p.y, 1e-12);
    EXPECT_NEAR(result.soup.properties[1].values[3 * i + 1], -p.x, 1e-12);
    EXPECT_NEAR(result.soup.properties[1].values[3 * i + 2], 5, 1e-12);
  }
}

TEST(CutSurfaces, keeps_each_surfaces_own_values_where_they_meet) {
  TriangleSoup soup = support::horizon_and_fault();
  soup.properties = {{"side", "", 1, {}}};
  for (std::size_t i = 0; i < soup.points.size(); ++i) soup.properties[0].values.push_back(i < 25 ? 1 : 2);
  const CutResult result = cut(soup);
  for (std::size_t t = 0; t < result.soup.triangles.size(); ++t)
    for (const std::uint32_t v : result.soup.triangles[t])
      EXPECT_NEAR(result.soup.properties[0].values[v], result.soup.triangle_patch[t] == 0 ? 1 : 2, 1e-14);
}

TEST(CutSurfaces, keeps_missing_values_missing_only_where_a_corner_misses_one) {
  TriangleSoup soup;
  support::add_triangle(soup, support::add_patch(soup, "H1"), {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  support::add_triangle(soup, support::add_patch(soup, "F1"), {1, -1, -1}, {1, 9, -1}, {1, 1, 3});
  soup.properties = {{"v", "", 1, {NAN, 2, 3, 1, 1, 1}}};
  const CutResult result = cut(soup);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < result.soup.points.size(); ++i)
    if (std::isnan(result.soup.properties[0].values[i])) {
      ++missing;
      EXPECT_LT(result.soup.points[i].x + result.soup.points[i].y, 4);
    }
  EXPECT_EQ(missing, 2u);  // the corner, and the point on the edge from it
}

TEST(CutSurfaces, cuts_these_by_those_and_leaves_those_alone) {
  const TriangleSoup soup = support::horizon_and_fault();
  const CutResult result = cut(soup, {.cut = {"H1"}, .cutting = {"F1"}});
  EXPECT_EQ(placed_triangles(result.soup, "F1"), placed_triangles(soup, "F1"));
  EXPECT_EQ(placed_triangles(result.soup, "H1"), placed_triangles(cut(soup).soup, "H1"));
  EXPECT_EQ(result.report.merged_points, 0u);
  EXPECT_EQ(result.report.pairs_left, 0u);
}

TEST(CutSurfaces, cuts_only_what_is_named) {
  TriangleSoup soup = support::horizon_and_fault();
  add_grid(soup, "F2", Role::fault, 3, {-0.9, 0.21, -0.6}, {1.7, 0.05, 0}, {0, 0, 1.3});
  const CutResult result = cut(soup, {.cut = {"F1", "F2"}, .cutting = {"F1", "F2"}});
  EXPECT_EQ(placed_triangles(result.soup, "H1"), placed_triangles(soup, "H1"));
  EXPECT_GT(placed_triangles(result.soup, "F1").size(), placed_triangles(soup, "F1").size());
  EXPECT_GT(placed_triangles(result.soup, "F2").size(), placed_triangles(soup, "F2").size());
  EXPECT_EQ(result.report.pairs_left, 0u);
}

TEST(CutSurfaces, fails_for_a_name_that_is_no_surface) {
  for (const CutSurfacesOptions& options :
       {CutSurfacesOptions{.cut = {"H7"}}, CutSurfacesOptions{.cutting = {"H1", "H7"}}}) {
    const Result<CutResult> result = cut_surfaces(support::horizon_and_fault(), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.failure().code, FailureCode::invalid_options);
    EXPECT_THAT(result.failure().what, testing::HasSubstr("H7"));
  }
}

TEST(CutSurfaces, drops_flat_and_repeated_triangles_and_tells) {
  TriangleSoup soup = support::horizon_and_fault();
  const CutResult clean = cut(soup);
  support::add_triangle(soup, 0, {0, 0, 0}, {1, 0, 0}, {0.5, 0, 0});                             // flat, along edges
  soup.triangles.push_back({soup.triangles[3][1], soup.triangles[3][2], soup.triangles[3][0]});  // one given twice
  soup.triangle_patch.push_back(0);
  soup.triangles.push_back({5, 5, 6});
  soup.triangle_patch.push_back(0);
  const CutResult result = cut(soup);
  EXPECT_EQ(result.report.dropped_triangles, 3u);
  ASSERT_FALSE(result.changes.empty());
  EXPECT_EQ(result.changes[0].kind, "dropped_triangles");
  EXPECT_EQ(improper_pairs(result.soup), 0u);
  EXPECT_EQ(placed_triangles(result.soup), placed_triangles(clean.soup));
}

TEST(CutSurfaces, makes_coinciding_triangles_of_two_entities_the_same) {
  TriangleSoup soup;
  add_grid(soup, "H1", Role::horizon, 3, {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  add_grid(soup, "H2", Role::horizon, 2, {1, 1, 0}, {3, 0, 0}, {0, 3, 0});
  const CutResult result = cut(soup);
  auto first = placed_triangles(result.soup, "H1"), second = placed_triangles(result.soup, "H2");
  for (auto* list : {&first, &second}) {
    std::erase_if(*list, [](const support::PlacedTriangle& t) {
      return !std::all_of(t.corners.begin(), t.corners.end(),
                          [](const Vec3& p) { return p.x >= 1 && p.y >= 1 && p.x <= 3 && p.y <= 3; });
    });
    for (support::PlacedTriangle& t : *list) t.name.clear();
  }
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, second);
  EXPECT_NEAR(area_of(result.soup, "H1"), 9, 1e-12);
  EXPECT_NEAR(area_of(result.soup, "H2"), 9, 1e-12);
}

TEST(CutSurfaces, takes_minus_zero_for_zero) {
  TriangleSoup soup;
  support::add_triangle(soup, support::add_patch(soup, "A"), {0.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  support::add_triangle(soup, support::add_patch(soup, "B"), {-0.0, -0.0, -0.0}, {1, -0.0, 0}, {0, 0, 1});
  const CutResult result = cut(soup);
  EXPECT_EQ(result.report.intersecting_pairs, 0u);
}

/// Coordinates as a file in single precision holds them: half a metre apart at UTM northings.
double in_single_precision(double x) { return static_cast<float>(x); }

TEST(CutSurfaces, joins_points_within_the_tolerance_as_single_precision_input_needs) {
  const Vec3 utm{456789, 6789012, 0};
  const auto rounded = [](const Vec3& p) {
    return Vec3{in_single_precision(p.x), in_single_precision(p.y), in_single_precision(p.z)};
  };
  // Two sheets that meet along one line, exported with coordinates that differ by less than the precision.
  TriangleSoup soup;
  add_grid(soup, "H1", Role::horizon, 8, utm, {800, 0, 0}, {0, 800, 100}, rounded);
  add_grid(soup, "F1", Role::fault, 8, utm + Vec3{800.01, 0.3, 0.001}, {0, 800, 100}, {50, 30, -500}, rounded);
  const CutResult result = cut(soup, {.tolerance_m = 1.5});
  EXPECT_GE(result.report.merged_points, 1u);
  EXPECT_LE(result.report.largest_move_m, 1.5);
  EXPECT_GT(result.report.largest_move_m, 0);
  EXPECT_EQ(result.report.pairs_left, 0u);
  EXPECT_EQ(improper_pairs(result.soup), 0u);
  ASSERT_FALSE(result.changes.empty());
  // The line is one: nine points shared by both.
  const WeldedPoints welded = weld_points(result.soup.points);
  EXPECT_EQ(welded.source.size(), 81u + 81u - 9u);
}

struct Noise {
  const char* what;
  double size;
  friend void PrintTo(const Noise& noise, std::ostream* stream) { *stream << noise.what; }
};
class NearlyCoplanar : public testing::TestWithParam<Noise> {};

TEST_P(NearlyCoplanar, sheets_end_without_improper_pairs) {
  const int trials = support::sanitized ? 1 : 8;
  for (int trial = 0; trial < trials; ++trial) {
    RandomStream random(static_cast<std::uint64_t>(trial));
    const auto noisy = [&](const Vec3& p) {
      return p + GetParam().size * Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
    };
    TriangleSoup soup;
    add_grid(soup, "H1", Role::horizon, 6, {0.1, 0.2, 1.3}, {1, 0, 0.2}, {0, 1, 0.1}, noisy);
    add_grid(soup, "H2", Role::horizon, 6, {0.1, 0.2, 1.3}, {1, 0, 0.2}, {0, 1, 0.1}, noisy);
    add_grid(soup, "H3", Role::horizon, 5, {0.15, 0.15, 1.3}, {1, 0, 0.2}, {0, 1, 0.1}, noisy);
    const CutResult result = cut(soup);
    EXPECT_EQ(result.report.pairs_left, 0u) << "trial " << trial;
    EXPECT_EQ(improper_pairs(result.soup), 0u) << "trial " << trial;
    EXPECT_LE(result.report.largest_move_m, std::max(10 * GetParam().size, 1e-9));
    for (const Vec3& p : result.soup.points) ASSERT_TRUE(is_finite(p));
    for (const char* name : {"H1", "H2", "H3"})
      EXPECT_NEAR(area_of(result.soup, name), area_of(soup, name), std::max(100 * GetParam().size, 1e-9));
  }
}
INSTANTIATE_TEST_SUITE_P(Noise, NearlyCoplanar,
                         testing::Values(Noise{"one_unit_in_the_last_place", 0x1p-51}, Noise{"four_units", 0x1p-49},
                                         Noise{"1e-14", 1e-14}, Noise{"1e-12", 1e-12}, Noise{"1e-9", 1e-9},
                                         Noise{"1e-5", 1e-5}));

struct RawModel {
  const char* name;
  double raw_ratio;
  friend void PrintTo(const RawModel& model, std::ostream* stream) {
    *stream << model.name << " raw " << model.raw_ratio;
  }
};
class RawModels : public testing::TestWithParam<RawModel> {};

TEST_P(RawModels, are_cut_without_improper_pairs_and_again_to_no_effect) {
  if (support::sanitized) GTEST_SKIP() << "too slow under sanitizers";
  const Result<TriangleSoup> soup = generate_reference_model(
      GetParam().name,
      {.resolution_m = std::string(GetParam().name) == "D" ? 10.0 : 120.0, .raw_ratio = GetParam().raw_ratio});
  ASSERT_TRUE(soup) << describe(soup.failure());
  const CutResult result = cut(*soup);
  EXPECT_EQ(result.report.pairs_left, 0u);
  EXPECT_EQ(improper_pairs(result.soup), 0u);
  for (const Vec3& p : result.soup.points) ASSERT_TRUE(is_finite(p));
  for (const Entity& entity : soup->entities)
    EXPECT_NEAR(area_of(result.soup, entity.name), area_of(*soup, entity.name), 1e-6 * area_of(*soup, entity.name))
        << entity.name;
  const CutResult again = cut(result.soup);
  EXPECT_EQ(again.report.intersecting_pairs, 0u);
  EXPECT_EQ(archive_bytes(again.soup), archive_bytes(result.soup));
}
INSTANTIATE_TEST_SUITE_P(Models, RawModels,
                         testing::Values(RawModel{"A1", -0.005}, RawModel{"A2", -0.005}, RawModel{"A3", -0.005},
                                         RawModel{"A3", 1e-6}, RawModel{"A4", -1e-6}, RawModel{"A5", -0.01},
                                         RawModel{"A6", -0.005}, RawModel{"A6", 1e-6}, RawModel{"B", -0.005},
                                         RawModel{"C", -0.005}, RawModel{"D", -0.005}));

TEST(CutSurfaces, ends_without_improper_pairs_on_random_tangles) {
  for (const support::TriangleKind kind : support::all_triangle_kinds)
    for (std::uint64_t seed = 0; seed < (support::sanitized ? 1 : 4); ++seed) {
      const TriangleSoup soup = support::soup_of(support::random_mesh(kind, 12, 1000 + seed));
      const CutResult result = cut(soup);
      EXPECT_EQ(result.report.pairs_left, 0u) << static_cast<int>(kind) << " seed " << seed;
      EXPECT_EQ(improper_pairs(result.soup), 0u) << static_cast<int>(kind) << " seed " << seed;
    }
}

}  // namespace
}  // namespace strataflow
