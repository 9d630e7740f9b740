// Regions that can only be filled with points inserted on their surfaces.
#include "kernels/volumes/split_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "graph/parallel/schedule.h"
#include "kernels/volumes/fill_regions.h"
#include "kernels/volumes/filled_model.h"
#include "kernels/volumes/merge_regions.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

/// A worker whose first calls fail: with the serial schedule and regions of equal size, those for the first regions.
class SplitSurfaces : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("split_surfaces_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path worker_that_fails_on_call(int call) {
    const std::filesystem::path program = folder_ / "fake_worker";
    std::filesystem::remove(folder_ / "calls");
    std::ofstream(program) << "#!/bin/sh\necho >> " << folder_ / "calls"
                           << "\n[ $(wc -l < " << folder_ / "calls"
                           << ") = " << call << " ] && exit 1\nexec " << support::tet_worker() << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return program;
  }

  /// Keeps surfaces in one attempt; when that fails, lets TetGen divide them to get small tetrahedra.
  static AttemptPlan plan() {
    return {{{"pYQ", false, false, false, false}}, {{"pqQa0.05", false, false, false, false}}};
  }

  std::filesystem::path folder_;
};

double area_of(const SurfaceTriangles& surfaces, std::uint32_t surface) {
  double area = 0;
  for (std::size_t t = 0; t < surfaces.triangles.size(); ++t) {
    if (surfaces.triangle_surface[t] != surface) continue;
    const Vec3& a = surfaces.points[surfaces.triangles[t][0]];
    area += 0.5 *
            length(cross(surfaces.points[surfaces.triangles[t][1]] - a, surfaces.points[surfaces.triangles[t][2]] - a));
  }
  return area;
}

TEST_F(SplitSurfaces, neighbours_take_the_points_that_one_region_puts_on_the_common_surfaces) {
  const StructuralModel model = support::model_of(support::layered_box({0, 1, 2, 3}));
  const ScheduleScope serial(ScheduleKind::serial);
  for (const int stubborn : {0, 1, 2}) {
    Result<FilledRegions> filled = fill_regions(model, {}, plan(), worker_that_fails_on_call(stubborn + 1), nullptr);
    ASSERT_TRUE(filled) << describe(filled.failure());
    const std::size_t inserted = filled->surfaces.points.size() - model.points.size();
    EXPECT_GT(inserted, 4u);
    for (std::uint32_t s = 0; s < model.surfaces.size(); ++s)
      EXPECT_NEAR(area_of(filled->surfaces, s), area_of(surface_triangles_of(model), s), 1e-12);
    const VolumeMesh mesh = *merged_regions(model, std::move(*filled));
    support::expect_valid(mesh, model);
    support::expect_model_points_kept(mesh, model);
    ASSERT_EQ(mesh.changes.size(), inserted + 1);
    EXPECT_EQ(mesh.changes[0].kind, "split_surfaces");
    EXPECT_THAT(mesh.changes[0].what, HasSubstr("(" + std::to_string(stubborn) + ")"));
    for (std::size_t i = 1; i < mesh.changes.size(); ++i) EXPECT_EQ(mesh.changes[i].kind, "inserted_surface_point");
  }
}

TEST_F(SplitSurfaces, a_dangling_fault_may_be_split_too) {
  const StructuralModel model = support::model_of(support::box_with_floating_fault());
  Result<FilledRegions> filled = fill_regions(model, {}, plan(), worker_that_fails_on_call(1), nullptr);
  ASSERT_TRUE(filled) << describe(filled.failure());
  const VolumeMesh mesh = *merged_regions(model, std::move(*filled));
  support::expect_valid(mesh, model);
  EXPECT_GT(mesh.facets.size(), model.triangles.size());
}

TEST_F(SplitSurfaces, points_on_a_line_divide_the_line_and_every_triangle_around_it) {
  const StructuralModel model = support::model_of(support::layered_box({0, 1, 2, 3}));
  const SurfaceTriangles surfaces = surface_triangles_of(model);
  const RegionBoundary boundary = region_boundary(model, surfaces, 0);
  SurfaceSplit split;
  const LineSegment segment = surfaces.segments.at(0);
  const auto point = static_cast<std::uint32_t>(surfaces.points.size());
  split.points = {0.5 * (surfaces.points[segment.first] + surfaces.points[segment.second])};
  split.edges = {{segment.first, segment.second, {point}}};
  RegionBoundary none = boundary;
  none.triangles.clear();  // no region of its own: every triangle is divided by the edge alone
  std::vector<std::uint8_t> changed;
  const SurfaceTriangles after = with_split(surfaces, none, split, changed);
  const auto around = static_cast<std::size_t>(std::count(changed.begin(), changed.end(), 1));
  EXPECT_GE(around, 3u);
  EXPECT_EQ(after.triangles.size(), surfaces.triangles.size() + around);
  EXPECT_EQ(after.segments.size(), surfaces.segments.size() + 1);
  EXPECT_EQ(after.point_line[point], static_cast<std::int32_t>(segment.line));
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) EXPECT_NEAR(area_of(after, s), area_of(surfaces, s), 1e-12);
}

TEST_F(SplitSurfaces, a_triangle_with_points_on_all_three_edges_is_divided_and_keeps_its_turn) {
  SurfaceTriangles surfaces;
  surfaces.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  surfaces.triangles = {{0, 1, 2}};
  surfaces.triangle_surface = {0};
  surfaces.point_line = {-1, -1, -1};
  SurfaceSplit split;
  split.points = {{1, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
  split.edges = {{0, 1, {3, 4}}, {0, 2, {5}}, {1, 2, {6}}};
  std::vector<std::uint8_t> changed;
  const SurfaceTriangles after = with_split(surfaces, {}, split, changed);
  EXPECT_EQ(after.triangles.size(), 5u);
  EXPECT_DOUBLE_EQ(area_of(after, 0), 8.0);
  for (const Triangle& t : after.triangles)
    EXPECT_GT(cross(after.points[t[1]] - after.points[t[0]], after.points[t[2]] - after.points[t[0]]).z, 0);
}

TEST_F(SplitSurfaces, are_not_made_when_the_options_forbid_them) {
  const StructuralModel model = support::model_of(support::box());
  TetrahedralizeOptions options;
  options.split_surfaces = "never";
  const Result<FilledRegions> filled = fill_regions(model, options, plan(), worker_that_fails_on_call(1), nullptr);
  ASSERT_FALSE(filled);
  EXPECT_EQ(filled.failure().code, FailureCode::geometry_failed);
}

}  // namespace
}  // namespace strataflow
