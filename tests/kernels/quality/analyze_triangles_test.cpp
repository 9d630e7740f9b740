#include "kernels/quality/analyze_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/archive.h"
#include "base/digest.h"
#include "graph/parallel/schedule.h"

namespace strataflow {
namespace {

TEST(MeasureTriangle, an_equilateral_triangle_is_best_by_every_measure) {
  const TriangleShape shape = measure_triangle({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0});
  EXPECT_NEAR(shape.area_m2, std::sqrt(3.0), 1e-14);
  for (const double angle : shape.angles_deg) EXPECT_NEAR(angle, 60, 1e-12);
  EXPECT_NEAR(shape.quality, 1, 1e-14);
  EXPECT_NEAR(shape.radius_ratio, 1, 1e-14);
}

TEST(MeasureTriangle, the_3_4_5_triangle_has_the_textbook_values) {
  const TriangleShape shape = measure_triangle({0, 0, 7}, {3, 0, 7}, {0, 4, 7});
  EXPECT_NEAR(shape.angles_deg[0], 90, 1e-12);
  EXPECT_NEAR(shape.angles_deg[1], 53.13010235415598, 1e-12);
  EXPECT_NEAR(shape.angles_deg[2], 36.86989764584402, 1e-12);
  EXPECT_NEAR(shape.quality, 6 * 6 / (std::sqrt(3.0) * 5 * 6), 1e-14);
  EXPECT_NEAR(shape.radius_ratio, 2 * 1 / 2.5, 1e-14);
}

TEST(MeasureTriangle, a_flat_or_shrunken_triangle_has_quality_zero_and_no_nan) {
  for (const TriangleShape& shape :
       {measure_triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), measure_triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1})}) {
    EXPECT_EQ(shape.quality, 0);
    EXPECT_EQ(shape.radius_ratio, 0);
    for (const double angle : shape.angles_deg) EXPECT_TRUE(angle >= 0 && angle <= 180);
  }
}

TEST(AnalyzeTriangles, reports_area_smallest_angle_and_the_share_below_30_degrees) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {10, 1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 3, 2}};  // 90 45 45 and 84.3 5.7 90
  const TriangleQualityReport report = analyze_triangles(points, triangles);
  EXPECT_EQ(report.triangles, 2u);
  EXPECT_NEAR(report.area_m2, 0.5 + 5, 1e-12);
  EXPECT_NEAR(report.min_angle_deg, std::atan(0.1) * 180 / M_PI, 1e-12);
  EXPECT_DOUBLE_EQ(report.angles_below_30_ratio, 1.0 / 6);
  EXPECT_EQ(report.angle_deg.bins[1], 1u);  // 5.7° lies in [5, 10)
  EXPECT_EQ(report.degenerate, 0u);
}

TEST(AnalyzeTriangles, an_empty_mesh_gives_zeros) {
  const TriangleQualityReport report = analyze_triangles({}, {});
  EXPECT_EQ(report.min_angle_deg, 0);
  EXPECT_EQ(report.mean_quality, 0);
  EXPECT_EQ(report.angles_below_30_ratio, 0);
}

TEST(AnalyzeTriangles, the_report_is_the_same_on_every_schedule) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 30000; ++i) {
    points.push_back({std::sin(i * 0.1), std::cos(i * 0.37), 0.001 * i});
    if (i >= 2) triangles.push_back({i - 2, i - 1, i});
  }
  const auto digest = [&] { return digest_of(archived(analyze_triangles(points, triangles))); };
  const Digest expected = digest();
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ScheduleScope scope(ScheduleKind::shuffled, seed);
    EXPECT_EQ(digest(), expected);
  }
}

}  // namespace
}  // namespace strataflow
