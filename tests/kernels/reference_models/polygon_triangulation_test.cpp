#include "kernels/reference_models/polygon_triangulation.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

double area(const std::vector<Triangle>& triangles, const std::vector<Vec3>& points) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double part = 0.5 * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z;
    EXPECT_GT(part, 0) << "turned over or flat";
    sum += part;
  }
  return sum;
}

std::vector<Triangle> triangulated(const std::vector<Vec3>& points) {
  std::vector<PolygonNode> polygon;
  for (std::uint32_t i = 0; i < points.size(); ++i) polygon.push_back({i, points[i].x, points[i].y});
  std::vector<Triangle> triangles;
  triangulate_polygon(polygon, points, triangles);
  EXPECT_EQ(triangles.size(), points.size() - 2);
  return triangles;
}

TEST(TriangulatePolygon, fills_a_square_with_many_points_on_its_sides) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 1, 0},
                                 {4, 4, 0}, {0, 4, 0}, {0, 3, 0}, {0, 1, 0}};
  EXPECT_DOUBLE_EQ(area(triangulated(points), points), 16);
}

TEST(TriangulatePolygon, fills_a_triangle_with_points_on_one_side_only) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 1e-3, 0}};
  EXPECT_DOUBLE_EQ(area(triangulated(points), points), 1.5e-3);
}

TEST(TriangulatePolygon, stays_inside_a_polygon_that_is_not_convex) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}};
  EXPECT_DOUBLE_EQ(area(triangulated(points), points), 8);
}

TEST(TriangulateStrip, joins_chains_of_different_lengths) {
  const std::vector<Vec3> points{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {1, 0, 0}, {1, 3, 0}};
  std::vector<Triangle> triangles;
  triangulate_strip({0, 1, 2, 3}, {4, 5}, points, triangles);
  EXPECT_EQ(triangles.size(), 4u);
  EXPECT_DOUBLE_EQ(area(triangles, points), 3);
}

TEST(TriangulateStrip, closes_where_the_chains_share_their_ends) {
  const std::vector<Vec3> points{{0, 0, 0}, {-1, 1, 0}, {-1, 2, 0}, {1, 1.5, 0}, {0, 3, 0}};
  std::vector<Triangle> triangles;
  triangulate_strip({0, 1, 2, 4}, {0, 3, 4}, points, triangles);
  EXPECT_EQ(triangles.size(), 3u);
  EXPECT_DOUBLE_EQ(area(triangles, points), 2 + 1.5);
}

}  // namespace
}  // namespace strataflow
