#include "kernels/remeshing/dual/piece_distance.h"

#include <gtest/gtest.h>

#include <array>

namespace strataflow {
namespace {

using Segment = std::array<Vec3, 2>;
using Square = std::array<Vec3, 4>;

const Square square{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(PieceDistance, nearest_point_of_a_polygon_is_inside_on_an_edge_or_a_corner) {
  EXPECT_EQ(nearest_on_polygon({0.25, 0.5, 3}, square), (Vec3{0.25, 0.5, 0}));
  EXPECT_EQ(nearest_on_polygon({0.5, -2, 1}, square), (Vec3{0.5, 0, 0}));
  EXPECT_EQ(nearest_on_polygon({4, 5, 1}, square), (Vec3{1, 1, 0}));
}

TEST(PieceDistance, the_ends_of_a_segment_are_met_exactly) {
  const Vec3 a{0.1, 0.2, 0.3}, b{0.7, 0.9, 1.1};
  EXPECT_EQ(nearest_on_segment(b + (b - a), a, b), b);
  EXPECT_EQ(nearest_on_segment(a - (b - a), a, b), a);
  EXPECT_EQ(nearest_on_segment({5, 5, 5}, a, a), a);
}

TEST(PieceDistance, segments_that_pass_each_other_are_nearest_inside) {
  EXPECT_DOUBLE_EQ(squared_distance_of_pieces(Segment{Vec3{-1, 0, 0}, {1, 0, 0}}, Segment{Vec3{0, -1, 2}, {0, 1, 2}}),
                   4);
}

TEST(PieceDistance, parallel_segments_are_as_far_as_their_lines_where_they_face) {
  EXPECT_DOUBLE_EQ(squared_distance_of_pieces(Segment{Vec3{0, 0, 0}, {2, 0, 0}}, Segment{Vec3{1, 3, 0}, {5, 3, 0}}), 9);
  EXPECT_DOUBLE_EQ(squared_distance_of_pieces(Segment{Vec3{0, 0, 0}, {1, 0, 0}}, Segment{Vec3{2, 0, 0}, {5, 0, 0}}), 1);
}

TEST(PieceDistance, of_polygons_is_between_faces_edges_or_corners) {
  Square above = square, beside = square;
  for (Vec3& p : above) p = 0.5 * p + Vec3{0.25, 0.25, 2};
  for (Vec3& p : beside) p = p + Vec3{3, 0.5, 0};
  EXPECT_DOUBLE_EQ(squared_distance_of_pieces(square, above), 4);
  EXPECT_DOUBLE_EQ(squared_distance_of_pieces(square, beside), 4);
  EXPECT_DOUBLE_EQ(squared_distance_of_pieces(Segment{Vec3{0.5, 0.5, 1}, {0.5, 0.5, 5}}, square), 1);
}

}  // namespace
}  // namespace strataflow
