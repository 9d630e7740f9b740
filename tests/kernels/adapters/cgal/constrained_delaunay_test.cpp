#include "kernels/adapters/cgal/constrained_delaunay.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

using Piece = SegmentArrangement::Piece;

TEST(ArrangeSegments, two_that_cross_become_four_pieces_around_a_new_point) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}};
  const auto arranged = arrange_segments(points, std::vector<PlaneSegment>{{0, 1}, {3, 2}});
  ASSERT_EQ(arranged.points.size(), 5u);
  EXPECT_EQ(arranged.points[4], (Vec3{1, 1, 0}));
  EXPECT_EQ(arranged.pieces, (std::vector<Piece>{{0, 4, 0}, {4, 1, 0}, {3, 4, 1}, {4, 2, 1}}));
}

TEST(ArrangeSegments, a_segment_is_cut_where_it_passes_through_a_point_or_overlaps_another) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {3, 0, 0}, {1, 0, 0}};
  const auto arranged = arrange_segments(points, std::vector<PlaneSegment>{{0, 1}, {2, 3}, {4, 2}});
  EXPECT_EQ(arranged.points.size(), 5u);
  EXPECT_EQ(arranged.place_of, (std::vector<std::uint32_t>{0, 1, 2, 3, 2}));
  EXPECT_EQ(arranged.pieces, (std::vector<Piece>{{0, 2, 0}, {2, 3, 0}, {3, 1, 0}, {2, 3, 1}}));
}

TEST(ArrangeSegments, three_through_one_point_share_it) {
  const std::vector<Vec3> points{{-3, -1, 0}, {3, 1, 0}, {-1, -3, 0}, {1, 3, 0}, {-2, 5, 0}, {2, -5, 0}};
  const auto arranged = arrange_segments(points, std::vector<PlaneSegment>{{0, 1}, {2, 3}, {4, 5}});
  ASSERT_EQ(arranged.points.size(), 7u);
  EXPECT_EQ(arranged.points[6], (Vec3{0, 0, 0}));
  EXPECT_EQ(arranged.pieces.size(), 6u);
}

TEST(ConstrainedDelaunay, holds_its_segments) {
  const std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {5, 1, 0}, {5, -1, 0}};
  const auto triangles = constrained_delaunay(points, std::vector<PlaneSegment>{{0, 1}});
  ASSERT_TRUE(triangles) << describe(triangles.failure());
  EXPECT_EQ(*triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 3, 1}}));
}

TEST(ConstrainedDelaunay, refuses_segments_that_cross_and_points_that_coincide) {
  const std::vector<Vec3> crossing{{0, 0, 0}, {2, 2, 0}, {0, 2, 0}, {2, 0, 0}};
  EXPECT_FALSE(constrained_delaunay(crossing, std::vector<PlaneSegment>{{0, 1}, {2, 3}}));
  const std::vector<Vec3> twice{{0, 0, 0}, {2, 2, 0}, {0, 0, 0}, {2, 0, 0}};
  EXPECT_FALSE(constrained_delaunay(twice, std::vector<PlaneSegment>{}));
}

}  // namespace
}  // namespace strataflow
