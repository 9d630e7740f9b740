#include "kernels/adapters/cgal/exact_position.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace strataflow {
namespace {

/// Two diagonals, a plane z = 0 and the planes x = 1 and y = 1.
const std::vector<Vec3> points{{0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0},
                               {1, 0, 1}, {0, 1, 0}, {1, 1, 1}, {0, 1, 1}, {1, 1, -1}};

TEST(ExactPosition, of_one_place_is_equal_however_it_is_defined) {
  const std::array<ExactPosition, 5> same{
      exact_position(points, vertex_point(5)), exact_position(points, two_edges_point({0, 1}, {2, 3}, 2)),
      exact_position(points, edge_and_plane_point({0, 1}, {4, 5, 6})),
      exact_position(points, edge_and_plane_point({8, 10}, {0, 1, 2})),
      exact_position(points, three_planes_point({{{0, 1, 2}, {4, 5, 6}, {7, 8, 9}}}))};
  for (const ExactPosition& p : same) {
    ASSERT_TRUE(p);
    EXPECT_EQ(compare(p, same[0]), 0);
    EXPECT_EQ(nearest_doubles(p), (Vec3{1, 1, 0}));
  }
  EXPECT_FALSE(ExactPosition());
}

TEST(ExactPosition, compares_where_doubles_cannot) {
  // z = 0 at x = 1/3 on one edge, and 2^-90 of an edge's length beside it on another.
  const std::vector<Vec3> close{{0, 0, -1}, {1, 0, 2},  {0, 0, 0},          {1, 0, 0},
                                {0, 1, 0},  {0, 0, -1}, {1 + 0x1p-52, 0, 2}};
  const ExactPosition third = exact_position(close, edge_and_plane_point({0, 1}, {2, 3, 4})),
                      beside = exact_position(close, edge_and_plane_point({5, 6}, {2, 3, 4}));
  EXPECT_EQ(compare(third, beside), -1);
  EXPECT_EQ(compare(beside, third), 1);
  EXPECT_EQ(compare_along(third, beside, 0), -1);
  EXPECT_EQ(compare_along(third, beside, 1), 0);
  EXPECT_EQ(nearest_doubles(third).x, 1.0 / 3);
  EXPECT_EQ(compare(third, exact_position({nearest_doubles(third)}, vertex_point(0))), 1) << "1/3 is no double";
}

TEST(ExactPosition, orients_as_doubles_do_along_every_axis) {
  const auto at = [](const Vec3& p) { return exact_position({p}, vertex_point(0)); };
  const Vec3 a{0, 0, 0}, b{1, 0.5, 2}, c{0.25, 3, -1};
  for (int axis = 0; axis < 3; ++axis) {
    const int s = axis == 0 ? 1 : 0, t = axis == 2 ? 1 : 2;
    const double area = (b[s] - a[s]) * (c[t] - a[t]) - (b[t] - a[t]) * (c[s] - a[s]);
    EXPECT_EQ(orientation_2d(at(a), at(b), at(c), axis), area > 0 ? 1 : -1);
    EXPECT_EQ(orientation_2d(at(a), at(c), at(b), axis), area > 0 ? -1 : 1);
    EXPECT_EQ(orientation_2d(at(a), at(b), at(b), axis), 0);
  }
}

TEST(ExactPosition, rounds_ties_to_even_and_knows_no_minus_zero) {
  const double ulp = 0x1p-52;
  const std::vector<Vec3> ties{
      {1, -1, -1},         {1 + ulp, 1, 1},        {0, 0, 0},      {1, 0, 0},         {0, 1, 0},
      {1 + ulp, -0.0, -1}, {1 + 2 * ulp, -0.0, 1}, {-1, -ulp, -1}, {-1 - ulp, ulp, 1}};
  const auto rounded = [&](std::uint32_t from) {
    return nearest_doubles(exact_position(ties, edge_and_plane_point({from, from + 1}, {2, 3, 4})));
  };
  EXPECT_EQ(rounded(0).x, 1);
  EXPECT_EQ(rounded(5).x, 1 + 2 * ulp);
  EXPECT_EQ(rounded(7).x, -1);
  for (const std::uint32_t from : {0u, 5u, 7u}) {
    EXPECT_FALSE(std::signbit(rounded(from).y));
    EXPECT_FALSE(std::signbit(rounded(from).z));
  }
}

}  // namespace
}  // namespace strataflow
