#include "kernels/cutting/cut_triangle.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// Triangle 0 in z = 0 and two upright ones that cross each other above (2, 2, 0).
struct Crossing {
  std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {1, 2, -1}, {3, 2, -1},
                           {2, 2, 3}, {2, 1, -1}, {2, 3, -1}, {2, 2, 4}};
  std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  CutPoints cut_points{points};
  std::vector<PointOnTriangle> on;
  std::vector<SegmentOnTriangle> segments;

  Crossing() {
    const auto ids =
        cut_points.identify({edge_and_plane_point({3, 5}, {0, 1, 2}), edge_and_plane_point({4, 5}, {0, 1, 2}),
                             edge_and_plane_point({6, 8}, {0, 1, 2}), edge_and_plane_point({7, 8}, {0, 1, 2})});
    for (const std::uint32_t id : ids) on.push_back({0, id, place_inside});
    std::sort(on.begin(), on.end());
    segments = {{0, {std::min(ids[0], ids[1]), std::max(ids[0], ids[1])}, 1, {no_index, no_index}},
                {0, {std::min(ids[2], ids[3]), std::max(ids[2], ids[3])}, 2, {no_index, no_index}}};
    std::sort(segments.begin(), segments.end());
  }
};

TEST(CutTriangle, finds_where_segments_cross_as_the_meeting_of_three_planes) {
  Crossing c;
  TriangleCutter cutter(c.cut_points, c.triangles);
  const auto crossings = cutter.find_crossings({0, c.on, c.segments});
  ASSERT_EQ(crossings.size(), 1u);
  EXPECT_EQ(crossings[0].definition, three_planes_point({c.triangles[0], c.triangles[1], c.triangles[2]}));
}

TEST(CutTriangle, refuses_segments_whose_crossing_is_no_point) {
  Crossing c;
  TriangleCutter cutter(c.cut_points, c.triangles);
  EXPECT_FALSE(cutter.triangulate({0, c.on, c.segments}));
}

TEST(CutTriangle, has_all_points_and_the_segments_in_pieces) {
  Crossing c;
  const std::uint32_t middle =
      c.cut_points.identify({three_planes_point({c.triangles[0], c.triangles[1], c.triangles[2]})})[0];
  EXPECT_EQ(c.cut_points.position(middle), (Vec3{2, 2, 0}));
  c.on.push_back({0, middle, place_inside});
  TriangleCutter cutter(c.cut_points, c.triangles);
  ASSERT_TRUE(cutter.triangulate({0, c.on, c.segments}));
  EXPECT_EQ(cutter.cells().size(), 2 * 8u - 3u - 2u);  // 2 n − h − 2 for n points, h of them on the border
  std::size_t spokes = 0;
  for (const auto& cell : cutter.cells())
    for (int k = 0; k < 3; ++k)
      spokes += cell.is_fixed[k] &&
                (cutter.point(cell.vertices[k]) == middle || cutter.point(cell.vertices[(k + 1) % 3]) == middle);
  EXPECT_EQ(spokes, 2 * 4u);
}

}  // namespace
}  // namespace strataflow
