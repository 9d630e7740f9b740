#include "kernels/remeshing/dual/polygon_triangles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strataflow {
namespace {

const Vec3 up{0, 0, 1};

TEST(PolygonTriangles, sharpness_is_the_sine_of_the_smallest_angle_signed_by_the_side) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0.5, std::sqrt(0.75), 0};
  EXPECT_NEAR(signed_sharpness(a, b, c, up), std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(signed_sharpness(a, c, b, up), -std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(signed_sharpness(a, {4, 0, 0}, {4, 3, 0}, up), 0.6, 1e-12);
  EXPECT_EQ(signed_sharpness(a, b, b, up), 0);
}

TEST(PolygonTriangles, a_kite_is_cut_across_its_short_diagonal) {
  const std::vector<Vec3> kite{{-3, 0, 0}, {0, -1, 0}, {3, 0, 0}, {0, 1, 0}};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3};
  std::vector<Triangle> triangles;
  EXPECT_GT(triangulate_polygon(corners, kite, up, triangles), 0.5);
  ASSERT_EQ(triangles.size(), 2u);
  for (const Triangle& t : triangles)
    EXPECT_FALSE((t[0] == 0 || t[1] == 0 || t[2] == 0) && (t[0] == 2 || t[1] == 2 || t[2] == 2));
}

TEST(PolygonTriangles, a_notch_is_never_cut_across_the_outside) {
  const std::vector<Vec3> notched{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.3, 0}, {0, 2, 0}};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4};
  std::vector<Triangle> triangles;
  EXPECT_GT(triangulate_polygon(corners, notched, up, triangles), 0);
  EXPECT_EQ(triangles.size(), 3u);
}

TEST(PolygonTriangles, fewer_than_three_corners_give_nothing) {
  std::vector<Triangle> triangles;
  EXPECT_EQ(triangulate_polygon(std::vector<std::uint32_t>{0, 1}, std::vector<Vec3>(2), up, triangles), 1);
  EXPECT_TRUE(triangles.empty());
}

TEST(PolygonTriangles, a_walk_through_one_corner_twice_is_two_polygons) {
  std::vector<std::vector<std::uint32_t>> polygons;
  split_at_repeats({0, 1, 2, 3, 1, 4}, polygons);
  ASSERT_EQ(polygons.size(), 2u);
  EXPECT_EQ(polygons[0], (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(polygons[1], (std::vector<std::uint32_t>{0, 1, 4}));
}

TEST(PolygonTriangles, a_walk_there_and_back_is_no_polygon) {
  std::vector<std::vector<std::uint32_t>> polygons;
  split_at_repeats({0, 1, 2, 1}, polygons);
  EXPECT_TRUE(polygons.empty());
}

}  // namespace
}  // namespace strataflow
