// The same points and triangles on every schedule, and from surfaces told in any order.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/archive.h"
#include "base/digest.h"
#include "io/read_input.h"
#include "kernels/cutting/cut_surfaces.h"
#include "kernels/cutting/surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "support/sanitized.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

Digest digest_of_cut(const TriangleSoup& soup, const CutSurfacesOptions& options = {}) {
  const Result<CutResult> result = cut_surfaces(soup, options);
  EXPECT_TRUE(result);
  ArchiveWriter writer;
  writer(*result);
  return digest_of(writer.bytes());
}

TriangleSoup generated(const char* name, double resolution_m, std::optional<double> raw_ratio = std::nullopt) {
  Result<TriangleSoup> soup = generate_reference_model(name, {.resolution_m = resolution_m, .raw_ratio = raw_ratio});
  EXPECT_TRUE(soup) << describe(soup.failure());
  return std::move(*soup);
}

/// Sheets on one plane but for noise: rounding makes intersections, and they are repaired.
TriangleSoup noisy_sheets() {
  RandomStream random(3);
  const auto noisy = [&](const Vec3& p) { return p + 1e-14 * Vec3{random.unit(), random.unit(), random.unit()}; };
  TriangleSoup soup;
  support::add_grid(soup, "H1", Role::horizon, 6, {0.1, 0.2, 1.3}, {1, 0, 0.2}, {0, 1, 0.1}, noisy);
  support::add_grid(soup, "H2", Role::horizon, 5, {0.15, 0.15, 1.3}, {1, 0, 0.2}, {0, 1, 0.1}, noisy);
  return soup;
}

TEST(CutOrder, of_schedules_changes_no_bit) {
  const std::vector<std::pair<TriangleSoup, CutSurfacesOptions>> cases{
      {generated("horizon-fault-pair", 20), {}},
      {generated("A3", 60, -0.005), {.tolerance_m = 0.5}},
      {noisy_sheets(), {}},
      {support::soup_of(support::random_mesh(support::TriangleKind::grid_3, 14, 5)), {}}};
  for (const auto& [soup, options] : cases) {
    const Digest expected = digest_of_cut(soup, options);
    support::on_every_schedule(
        [&](const char* schedule) { EXPECT_EQ(digest_of_cut(soup, options).hex(), expected.hex()) << schedule; }, 3);
  }
}

std::vector<Vec3> distinct_points(const TriangleSoup& soup) {
  std::vector<Vec3> points;
  for (const Triangle& t : soup.triangles)
    for (const std::uint32_t v : t) points.push_back(soup.points[v]);
  std::sort(points.begin(), points.end(), support::ByPosition{});
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

void expect_the_same_from_any_order(const TriangleSoup& soup, int shuffles) {
  const Result<CutResult> expected = cut_surfaces(soup);
  ASSERT_TRUE(expected);
  EXPECT_GT(expected->report.cut_triangles, 0u);
  for (int seed = 0; seed < shuffles; ++seed) {
    const Result<CutResult> result = cut_surfaces(support::shuffled(soup, static_cast<std::uint64_t>(seed)));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->report.pieces, expected->report.pieces);
    EXPECT_EQ(result->report.new_points, expected->report.new_points);
    ASSERT_TRUE(distinct_points(result->soup) == distinct_points(expected->soup)) << "shuffle " << seed;
    ASSERT_TRUE(support::placed_triangles(result->soup) == support::placed_triangles(expected->soup))
        << "shuffle " << seed;
  }
}

TEST(CutOrder, of_a_generated_pair_changes_no_point_and_no_triangle) {
  expect_the_same_from_any_order(generated("horizon-fault-pair", 25), 4);
}
TEST(CutOrder, of_raw_surfaces_changes_no_point_and_no_triangle) {
  expect_the_same_from_any_order(generated("A5", 60, -0.005), 3);
}

/// A grazing unconformity: points that round to one place, triangles that coincide, and much to repair afterwards.
TEST(CutOrder, of_surfaces_that_graze_each_other_changes_no_point_and_no_triangle) {
  const TriangleSoup soup = generated("A6", 60, -0.01);
  const CutReport report = cut_surfaces(soup)->report;
  EXPECT_GT(report.rounds, 1u);
  EXPECT_LT(report.rounds, 10u);
  EXPECT_EQ(report.pairs_left, 0u);
  expect_the_same_from_any_order(soup, support::sanitized ? 1 : 3);
}
TEST(CutOrder, of_three_crossing_sheets_changes_no_point_and_no_triangle) {
  TriangleSoup soup = support::horizon_and_fault(7);
  support::add_grid(soup, "F2", Role::fault, 6, {-0.9, 0.21, -0.6}, {1.7, 0.05, 0}, {0, 0, 1.3});
  expect_the_same_from_any_order(soup, 6);
}

TEST(CutOrder, of_classic_arrangements_changes_no_point_and_no_triangle) {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  const std::filesystem::path data =
      folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data";
  for (const char* name : {"three_cubes.stl", "two_spheres.stl", "40509.stl"}) {
    const std::filesystem::path file = data / "arrangement" / name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here (set STRATAFLOW_DATA)";
    const Result<InputData> input = read_input(file);
    ASSERT_TRUE(input);
    SCOPED_TRACE(name);
    expect_the_same_from_any_order(input->surfaces, support::sanitized ? 1 : 3);
  }
}

}  // namespace
}  // namespace strataflow
