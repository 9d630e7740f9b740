#include "kernels/cutting/points_in_triangle.h"

#include <gtest/gtest.h>

#include "kernels/cutting/rounded_position.h"

namespace strataflow {
namespace {

/// Corners 0–2 in z = 0; edges 3–4, 5–6 and 7–8 pierce it.
const std::vector<Vec3> input{{0, 0, 0},    {3, 0, 0},   {0, 3, 0},      {1, 1, -1},   {1, 1, 1},
                              {0, 0.5, -1}, {2, 0.5, 1}, {0.5, 0.5, -1}, {0.5, 0.5, 1}};

std::uint32_t add_piercing(PointsInTriangle& points, const std::vector<Vec3>& all, std::uint32_t from,
                           PlaceInTriangle place = place_inside) {
  const PointDefinition definition = edge_and_plane_point({from, from + 1}, {0, 1, 2});
  return points.add(definition, rounded_position(all, definition), place);
}

TEST(PointsInTriangle, see_the_corners_counter_clockwise_whichever_way_the_triangle_looks) {
  for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{0, 2, 1}, Triangle{2, 1, 0}}) {
    PointsInTriangle points(input);
    points.restart(t);
    EXPECT_EQ(points.count(), 3u);
    EXPECT_EQ(points.orientation(0, 1, 2), 1);
    EXPECT_EQ(points.orientation(0, 2, 1), -1);
  }
}

TEST(PointsInTriangle, know_what_lies_on_a_line_though_rounding_could_hide_it) {
  // (0.5, 0.5), (1, 1) and the corner (0, 0) are one line.
  PointsInTriangle points(input);
  points.restart({0, 1, 2});
  const std::uint32_t one = add_piercing(points, input, 3), half = add_piercing(points, input, 7),
                      off = add_piercing(points, input, 5);
  EXPECT_EQ(points.orientation(0, half, one), 0);
  EXPECT_TRUE(points.is_between(half, 0, one));
  EXPECT_FALSE(points.is_between(one, 0, half));
  EXPECT_TRUE(points.precedes(half, one, 0, one));
  EXPECT_TRUE(points.precedes(one, half, one, 0));
  EXPECT_EQ(points.orientation(0, one, off), -1);
}

TEST(PointsInTriangle, tell_places_apart_that_round_to_one_position) {
  // An edge that pierces 2^-80 beside (1, 1): the same doubles, to the right of the diagonal.
  std::vector<Vec3> close = input;
  close.insert(close.end(), {{1, 1, -1}, {1 + 0x1p-52, 1, 0x1p30}});
  PointsInTriangle points(close);
  points.restart({0, 1, 2});
  const std::uint32_t one = add_piercing(points, close, 3), beside = add_piercing(points, close, 9);
  EXPECT_EQ(points.rounded(one), points.rounded(beside));
  EXPECT_EQ(points.orientation(0, one, beside), -1);
  EXPECT_EQ(points.orientation(0, beside, one), 1);
  EXPECT_EQ(points.orientation(2, one, beside), 1);
}

TEST(PointsInTriangle, on_one_edge_are_one_line_by_their_places) {
  PointsInTriangle points(input);
  points.restart({0, 1, 2});
  const std::uint32_t a = add_piercing(points, input, 3, 4);  // told to lie on edge 1–2
  EXPECT_EQ(points.orientation(1, 2, a), 0);
}

TEST(PointsInTriangle, are_in_a_circle_only_when_that_is_sure) {
  PointsInTriangle points(input);
  points.restart({0, 1, 2});
  const std::uint32_t one = add_piercing(points, input, 3);
  EXPECT_TRUE(points.is_surely_in_circle(0, 1, 2, one));
  EXPECT_FALSE(points.is_surely_in_circle(0, 1, one, 2));
  EXPECT_FALSE(points.is_surely_in_circle(0, 1, 2, 0)) << "on the circle";
}

}  // namespace
}  // namespace strataflow
