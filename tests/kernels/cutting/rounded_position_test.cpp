#include "kernels/cutting/rounded_position.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/seed.h"
#include "kernels/adapters/cgal/exact_position.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {
namespace {

TEST(RoundedPosition, of_a_vertex_is_the_vertex) {
  EXPECT_EQ(rounded_position({{1, 2, 3}, {4, 5, 6}}, vertex_point(1)), (Vec3{4, 5, 6}));
}

TEST(RoundedPosition, of_an_edge_through_a_plane_is_correctly_rounded) {
  // z = 1 third of the way: the nearest double to 1/3.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 3, 3}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  EXPECT_EQ(rounded_position(points, edge_and_plane_point({0, 1}, {2, 3, 4})), (Vec3{1.0 / 3, 1, 1}));
}

TEST(RoundedPosition, goes_to_the_even_neighbour_in_a_tie) {
  // x at the middle of an edge: exactly between two doubles.
  const double ulp = 0x1p-52;
  const std::vector<Vec3> points{{1, 0, -1}, {1 + ulp, 0, 1},     {0, 0, 0},       {1, 0, 0},
                                 {0, 1, 0},  {1 + 2 * ulp, 0, 1}, {1 + ulp, 0, -1}};
  EXPECT_EQ(rounded_position(points, edge_and_plane_point({0, 1}, {2, 3, 4})).x, 1);
  EXPECT_EQ(rounded_position(points, edge_and_plane_point({6, 5}, {2, 3, 4})).x, 1 + 2 * ulp);
}

TEST(RoundedPosition, has_no_minus_zero) {
  const std::vector<Vec3> points{{-1, 0, -1}, {1, -0.0, 1},    {0, 0, 0},       {1, 0, 0},
                                 {0, 1, 0},   {-0.0, -0.0, 1}, {-0.0, -0.0, -1}};
  for (const auto& edge : {std::array<std::uint32_t, 2>{0, 1}, {5, 6}}) {
    const Vec3 p = rounded_position(points, edge_and_plane_point(edge, {2, 3, 4}));
    EXPECT_EQ(p, (Vec3{0, 0, 0}));
    for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(p[axis]));
  }
}

TEST(RoundedPosition, of_three_planes_is_where_they_meet) {
  const std::vector<Vec3> points{{1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 2, 0}, {1, 2, 0},
                                 {0, 2, 1}, {0, 0, 3}, {1, 0, 3}, {0, 1, 3}};
  EXPECT_EQ(rounded_position(points, three_planes_point({{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}})), (Vec3{1, 2, 3}));
}

TEST(RoundedPosition, of_two_edges_is_where_they_cross) {
  const std::vector<Vec3> points{{0, 0, 5}, {2, 2, 5}, {0, 2, 5}, {2, 0, 5}};
  EXPECT_EQ(rounded_position(points, two_edges_point({0, 1}, {2, 3}, 2)), (Vec3{1, 1, 5}));
}

/// The quick arithmetic and the rational one give the same bits, also where points nearly coincide.
TEST(RoundedPosition, is_what_rational_arithmetic_rounds_to) {
  RandomStream random(11);
  int definite = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double offset = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 1000 : 6e6;
    const double size = trial % 2 == 0 ? 1 : 1e-6;
    std::vector<Vec3> points;
    for (int i = 0; i < 9; ++i)
      points.push_back(
          {offset + size * random.unit(), offset + size * random.unit(), 0.5 * offset + size * random.unit()});
    if (trial % 5 == 0)
      points[4] = points[2] + 0.5 * (points[3] - points[2]) + 1e-15 * Vec3{1, 2, 3};  // a sliver of a plane
    const auto expect_same = [&](const PointDefinition& d) {
      ASSERT_EQ(rounded_position(points, d), nearest_doubles(exact_position(points, d))) << "trial " << trial;
      ++definite;
    };
    const int above = orientation_3d(points[2], points[3], points[4], points[0]),
              below = orientation_3d(points[2], points[3], points[4], points[1]);
    if (above * below < 0) expect_same(edge_and_plane_point({0, 1}, {2, 3, 4}));
    if (trial % 5 != 0) expect_same(three_planes_point({{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}}));
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(definite, 15000);
}

}  // namespace
}  // namespace strataflow
