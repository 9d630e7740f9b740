#include "kernels/cutting/identify_points.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

using Indices = std::vector<std::uint32_t>;

/// A cross of edges in z = 0, planes x = 1 and y = 1, and an edge along z through (1, 1, 0).
const std::vector<Vec3> points{{0, 0, 0},  {2, 2, 0}, {0, 2, 0}, {2, 0, 0},  {1, 1, 0},  {1, 0, 1}, {1, 2, 1},
                               {1, 0, -1}, {0, 1, 1}, {2, 1, 1}, {0, 1, -1}, {1, 1, -1}, {1, 1, 1}, {1, 1, 3}};
const PointDefinition by_edges = two_edges_point({0, 1}, {2, 3}, 2), by_plane = edge_and_plane_point({0, 1}, {5, 6, 7}),
                      by_planes = three_planes_point({{{0, 1, 2}, {5, 6, 7}, {8, 9, 10}}}),
                      elsewhere = edge_and_plane_point({11, 13}, {5, 8, 9});  // (1, 1, 1)

TEST(IdentifyPoints, gives_one_index_to_all_definitions_of_one_place) {
  std::vector<Vec3> without_middle = points;
  without_middle[4] = {7, 7, 7};
  CutPoints cut(without_middle);
  const auto first = static_cast<std::uint32_t>(points.size());
  EXPECT_EQ(cut.identify({by_edges, by_plane, by_planes, by_edges}), (Indices{first, first, first, first}));
  EXPECT_EQ(cut.count(), first + 1);
  EXPECT_EQ(cut.position(first), (Vec3{1, 1, 0}));
}

TEST(IdentifyPoints, takes_an_input_point_that_lies_exactly_there) {
  CutPoints cut(points);
  EXPECT_EQ(cut.identify({by_planes, vertex_point(4), by_plane}), (Indices{4, 4, 4}));
  EXPECT_EQ(cut.count(), points.size());
  EXPECT_EQ(cut.identify({by_edges}), (Indices{4})) << "also when asked later";
}

TEST(IdentifyPoints, keeps_places_apart_that_round_to_the_same_doubles) {
  // x = 1/3 of the way along edges that differ by less than rounding can tell.
  const double small = 0x1p-80;
  const std::vector<Vec3> close{{1, 0, -1},           {2, 0, 2}, {0, 0, 0},      {1, 0, 0}, {0, 1, 0},
                                {1, 0, -1 + 0x1p-52}, {2, 0, 2}, {small, 0, -1}, {0, 0, 1}, {0, small, 0}};
  CutPoints cut(close);
  const Indices ids = cut.identify({edge_and_plane_point({0, 1}, {2, 3, 4}), edge_and_plane_point({0, 1}, {3, 4, 9})});
  EXPECT_EQ(ids[0], ids[1]) << "one plane, told by other points";
  const Indices others = cut.identify({edge_and_plane_point({5, 6}, {2, 3, 4})});
  EXPECT_NE(others[0], ids[0]);
}

TEST(IdentifyPoints, numbers_new_points_by_position_whatever_the_order_of_definitions) {
  std::vector<Vec3> moved = points;
  moved[4] = {7, 7, 7};
  moved[12] = {8, 8, 8};
  CutPoints forward(moved), backward(moved);
  const Indices a = forward.identify({by_edges, elsewhere, by_planes}),
                b = backward.identify({by_planes, elsewhere, by_edges});
  EXPECT_EQ(a, (Indices{b[2], b[1], b[0]}));
  EXPECT_LT(a[0], a[1]);
}

}  // namespace
}  // namespace strataflow
